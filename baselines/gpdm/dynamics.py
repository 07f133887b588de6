"""Priors of latent trajectories: Markov chains of any order, and none (the GPLVM).

The function that leads from the last positions to the next is integrated out, GPDM (10); several
sequences share it, (15) and (16); it may depend on two positions, (17), or predict the step, (19).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gpdm.process import Conditioned, Process

__all__ = ["Dynamics", "Markov", "Motion", "Static"]

Array = NDArray[np.float64]
Index = NDArray[np.intp]


class Motion(ABC):
    """What a learnt prior says of a new trajectory."""

    order: int
    """On how many positions the next one depends."""

    @abstractmethod
    def negative_log_density(self, x: Array) -> tuple[float, Array]:
        """Return −ln p(x | training) of a new sequence ``x`` (M, d), and its slope."""

    @abstractmethod
    def step(self, history: Array) -> tuple[Array, Array]:
        """Return mean (n, d) and variance (n,) of the positions after ``history``.

        Parameters
        ----------
        history : ndarray of shape (n, order, d)
            The last position first.
        """


class Dynamics(ABC):
    """A prior of latent trajectories with positive parameters."""

    @property
    @abstractmethod
    def start(self) -> Array:
        """The logarithms of the parameters that learning starts from."""

    @abstractmethod
    def negative_log_prior(
        self, theta: Array, x: Array, lengths: Sequence[int]
    ) -> tuple[float, Array, Array]:
        """Return −ln p(x) of sequences stacked in ``x`` (N, d), and its slopes in x and theta."""

    @abstractmethod
    def conditioned(self, theta: Array, x: Array, lengths: Sequence[int]) -> Motion:
        """Return the prior of a further sequence, given those in ``x``."""

    @abstractmethod
    def properties(self, theta: Array, n_latent: int) -> dict[str, float]:
        """Return the signal-to-noise ratio and characteristic lengthscale of GPDM Table 1."""


@dataclass(frozen=True)
class _Lags:
    """Rows of stacked sequences: of each position, of those before it, and of the first ones."""

    now: Index
    before: Index
    first: Index

    @classmethod
    def of(cls, lengths: Sequence[int], order: int) -> _Lags:
        frames = np.concatenate([np.arange(length) for length in lengths])
        rows = np.arange(len(frames))
        now = rows[frames >= order]
        return cls(now, now[:, None] - np.arange(1, order + 1), rows[frames < order])


@dataclass(frozen=True)
class Markov(Dynamics):
    r"""x_t − c x_{t−1} = f(x_{t−1}, …, x_{t−order}) + noise, f a Gaussian process.

    Parameters
    ----------
    process : Process
    order : int, default=1
    carry : float, default=0.0
        c: 0 predicts the position, 1 the step (velocity prediction).
    """

    process: Process
    order: int = 1
    carry: float = 0.0

    @property
    def start(self) -> Array:
        """Those of the process."""
        return self.process.start

    def _pairs(self, x: Array, lags: _Lags) -> tuple[Array, Array]:
        inputs = x[lags.before].reshape(len(lags.now), self.order * x.shape[1])
        return inputs, x[lags.now] - self.carry * x[lags.before[:, 0]]

    def _pull(self, x: Array, lags: _Lags, d_inputs: Array, d_targets: Array) -> Array:
        """Return the slope in x of pairs and of the standard normal prior of the first ones."""
        slope = np.zeros_like(x)
        by_lag = d_inputs.reshape(len(lags.now), self.order, x.shape[1])
        for lag in range(self.order):
            slope[lags.before[:, lag]] += by_lag[:, lag]
        slope[lags.now] += d_targets
        slope[lags.before[:, 0]] -= self.carry * d_targets
        slope[lags.first] += x[lags.first]
        return slope

    def negative_log_prior(
        self, theta: Array, x: Array, lengths: Sequence[int]
    ) -> tuple[float, Array, Array]:
        """Return GPDM (29) and its slopes."""
        lags = _Lags.of(lengths, self.order)
        found = self.process.negative_log_likelihood(theta, *self._pairs(x, lags))
        value = found.value + 0.5 * float((x[lags.first] ** 2).sum())
        return value, self._pull(x, lags, found.inputs, found.targets), found.theta

    def conditioned(self, theta: Array, x: Array, lengths: Sequence[int]) -> Motion:
        """Return GPDM (26)."""
        pairs = self._pairs(x, _Lags.of(lengths, self.order))
        return _MarkovMotion(self.order, self, self.process.conditioned(theta, *pairs))

    def properties(self, theta: Array, n_latent: int) -> dict[str, float]:
        """Return SNR(α) and CLS(α)."""
        scales = self.process.kernel.lengthscales(theta[:-1])
        ratio = self.process.signal_to_noise(theta, self.order * n_latent)
        return {"SNR(α)": ratio, **dict(zip(("CLS(α)", "CLS(α) of lag 2"), scales, strict=False))}


@dataclass(frozen=True)
class _MarkovMotion(Motion):
    order: int
    dynamics: Markov
    process: Conditioned

    def negative_log_density(self, x: Array) -> tuple[float, Array]:
        lags = _Lags.of([len(x)], self.order)
        inputs, targets = self.dynamics._pairs(x, lags)
        everywhere = np.ones(len(targets), dtype=bool)
        value, d_inputs, d_targets = self.process.negative_log_density(inputs, targets, everywhere)
        value += 0.5 * float((x[lags.first] ** 2).sum())
        return value, self.dynamics._pull(x, lags, d_inputs, d_targets)

    def step(self, history: Array) -> tuple[Array, Array]:
        inputs = history.reshape(len(history), -1)
        mean, variance = self.process.marginals(inputs)
        return mean + self.dynamics.carry * history[:, 0], variance


@dataclass(frozen=True)
class Static(Dynamics, Motion):
    """Independent standard normal positions: the prior of the GPLVM, which knows no time."""

    order: int = 1

    @property
    def start(self) -> Array:
        """No parameters."""
        return np.empty(0)

    def negative_log_prior(
        self, theta: Array, x: Array, lengths: Sequence[int]
    ) -> tuple[float, Array, Array]:
        """Return ½‖x‖²."""
        del lengths
        return 0.5 * float((x**2).sum()), x, np.zeros_like(theta)

    def conditioned(self, theta: Array, x: Array, lengths: Sequence[int]) -> Motion:
        """Return itself: other sequences say nothing."""
        del theta, x, lengths
        return self

    def properties(self, theta: Array, n_latent: int) -> dict[str, float]:
        """Return nothing."""
        del theta, n_latent
        return {}

    def negative_log_density(self, x: Array) -> tuple[float, Array]:
        """Return ½‖x‖²."""
        return 0.5 * float((x**2).sum()), x

    def step(self, history: Array) -> tuple[Array, Array]:
        """Return the prior, whatever came before."""
        return np.zeros_like(history[:, 0]), np.ones(len(history))
