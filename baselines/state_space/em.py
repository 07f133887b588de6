"""Expectation–maximisation for one linear Gaussian state-space model."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

from mocapbench.baselines.common.ascent import Ascent, ascend
from mocapbench.baselines.state_space.maximisation import maximise_parameters
from mocapbench.baselines.state_space.model import Priors, StateSpaceParameters
from mocapbench.baselines.state_space.observations import Observations
from mocapbench.baselines.state_space.smoothing import Smoothed, smooth_states

__all__ = ["Expected", "expectation_maximisation"]


@dataclass(frozen=True, eq=False)
class Expected:
    """Parameters, and the states that they make of the data.

    Parameters
    ----------
    parameters : StateSpaceParameters
    states : Smoothed
    """

    parameters: StateSpaceParameters
    states: Smoothed

    @classmethod
    def of(cls, parameters: StateSpaceParameters, data: Observations) -> Self:
        """Take the E-step."""
        return cls(parameters, smooth_states(parameters, data))

    def objective(self, priors: Priors) -> float:
        """Return the log-likelihood plus the log-prior."""
        return float(self.states.log_likelihood.sum()) + self.parameters.log_prior(priors)


def expectation_maximisation(
    parameters: StateSpaceParameters,
    data: Observations,
    priors: Priors,
    *,
    max_iter: int,
    tol: float,
) -> Ascent[Expected]:
    """Alternate M-step and E-step, ``max_iter`` times at most.

    Stops when an iteration raises the objective by less than ``tol`` per visible entry.
    """
    return ascend(
        Expected.of(parameters, data),
        lambda now: Expected.of(maximise_parameters(now.states, data, priors), data),
        lambda now: now.objective(priors),
        max_iter=max_iter,
        threshold=tol * data.counts.sum(),
    )
