"""The parameters of a linear Gaussian state-space model, and their weak priors."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mocapbench.baselines.state_space.regression import Prior, Regression
from mocapbench.basics.arrays import Array

__all__ = ["PRIORS", "Priors", "StateSpaceParameters"]


@dataclass(frozen=True)
class Priors:
    """The priors of the three regressions that make up the model.

    Parameters
    ----------
    start : Prior
        Of the first state: a regression on 1.
    dynamics : Prior
        Of the next state on the state.
    emission : Prior
        Of each channel on the state and 1.
    """

    start: Prior
    dynamics: Prior
    emission: Prior


PRIORS = Priors(
    start=Prior(frames=10.0, variance=1.0, ridge=1.0),
    dynamics=Prior(frames=1.0, variance=1e-2, ridge=1e-2),
    emission=Prior(frames=10.0, variance=1.0, ridge=1.0),
)
"""A recording is one frame of the start, so that a few recordings leave it nearly N(0, I)."""


@dataclass(frozen=True, eq=False)
class StateSpaceParameters:
    """The parameters of the model of q states and D channels.

    Parameters
    ----------
    start : Regression
        Mean m as (q, 1) and covariance P (q, q) of the first state.
    dynamics : Regression
        Transition A (q, q) and covariance Q (q, q) of its noise.
    emission : Regression
        By channel the row of (C, d) as (D, 1, q + 1), and the variance r as (D, 1, 1).
    """

    start: Regression
    dynamics: Regression
    emission: Regression

    @property
    def n_states(self) -> int:
        """The number q of states."""
        return len(self.dynamics.coefficients)

    @property
    def loadings(self) -> Array:
        """C (D, q)."""
        return self.emission.coefficients[:, 0, :-1]

    @property
    def offset(self) -> Array:
        """The offset d (D,) of the channels."""
        return self.emission.coefficients[:, 0, -1]

    @property
    def noise(self) -> Array:
        """The variance r (D,) of the channels' noise."""
        return self.emission.covariance[:, 0, 0]

    @cached_property
    def squares(self) -> Array:
        """(D, q²) the outer product of each channel's loadings with themselves."""
        products = self.loadings[:, :, None] * self.loadings[:, None, :]
        return np.asarray(products.reshape(len(products), -1))

    def log_prior(self, priors: Priors) -> float:
        """Return the log-density of the priors up to a constant."""
        return (
            self.start.log_prior(priors.start)
            + self.dynamics.log_prior(priors.dynamics)
            + self.emission.log_prior(priors.emission)
        )
