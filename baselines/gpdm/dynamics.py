"""Priors of latent trajectories: Markov dynamics of any order, and independent positions (GPLVM).

The function from the last positions to the next one is integrated out, GPDM eq. (10). Several
sequences share it, (15) and (16); it may depend on the last two positions, (17), or predict the
step instead of the position, (19).

Wang, Fleet and Hertzmann (2008), *Gaussian Process Dynamical Models for Human Motion*, IEEE TPAMI
30(2), is cited as GPDM.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.gpdm.process import ConditionedProcess, Process
from mocapbench.basics.arrays import Array, Index

__all__ = ["ConditionedDynamics", "Dynamics", "Markov", "Static"]


class ConditionedDynamics(ABC):
    """The prior of a new trajectory, given the training trajectories."""

    order: int
    """Number of previous positions on which the next one depends."""

    @abstractmethod
    def negative_log_density(self, x: Array) -> tuple[float, Array]:
        """Return −ln p(x | training) of a new trajectory ``x`` (M, d), and its gradient."""

    @abstractmethod
    def step(self, history: Array) -> tuple[Array, Array]:
        """Return the mean (n, d) and variance (n,) of the positions that follow ``history``.

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
        """Return −ln p(x) of sequences stacked in ``x`` (N, d), and its gradients.

        The gradients are those with respect to ``x`` and to the log-parameters ``theta``.
        """

    @abstractmethod
    def condition(self, theta: Array, x: Array, lengths: Sequence[int]) -> ConditionedDynamics:
        """Return the prior of a further trajectory, given those stacked in ``x`` (N, d)."""

    @abstractmethod
    def properties(self, theta: Array, n_latent: int) -> dict[str, float]:
        """Return the signal-to-noise ratio and characteristic lengthscale, as in GPDM Table 1."""


@dataclass(frozen=True)
class _Lags:
    """Rows of stacked sequences that the dynamics relate.

    Parameters
    ----------
    now : ndarray of int, shape (P,)
        Positions that have ``order`` predecessors.
    before : ndarray of int, shape (P, order)
        Their predecessors, the last one first.
    first : ndarray of int
        Positions without as many predecessors.
    """

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
        The prior of f, with the noise.
    order : int, default=1
        Number of previous positions on which the next one depends.
    carry : float, default=0.0
        The factor c: 0 predicts the position, 1 the step (velocity prediction, GPDM eq. 19).
    """

    process: Process
    order: int = 1
    carry: float = 0.0

    @property
    def start(self) -> Array:
        """The start of the process."""
        return self.process.start

    def _pairs(self, x: Array, lags: _Lags) -> tuple[Array, Array]:
        inputs = x[lags.before].reshape(len(lags.now), self.order * x.shape[1])
        return inputs, x[lags.now] - self.carry * x[lags.before[:, 0]]

    def _pull(self, x: Array, lags: _Lags, d_inputs: Array, d_targets: Array) -> Array:
        """Return the gradient (N, d) in x, given those in the pairs of inputs and targets.

        The first positions of a sequence have a standard normal prior, whose gradient is added.
        """
        gradient = np.zeros_like(x)
        by_lag = d_inputs.reshape(len(lags.now), self.order, x.shape[1])
        for lag in range(self.order):
            gradient[lags.before[:, lag]] += by_lag[:, lag]
        gradient[lags.now] += d_targets
        gradient[lags.before[:, 0]] -= self.carry * d_targets
        gradient[lags.first] += x[lags.first]
        return gradient

    def negative_log_prior(
        self, theta: Array, x: Array, lengths: Sequence[int]
    ) -> tuple[float, Array, Array]:
        """Return GPDM eq. (29) and its gradients."""
        lags = _Lags.of(lengths, self.order)
        pairs = self.process.negative_log_likelihood(theta, *self._pairs(x, lags))
        value = pairs.value + 0.5 * float((x[lags.first] ** 2).sum())
        return value, self._pull(x, lags, pairs.inputs, pairs.targets), pairs.theta

    def condition(self, theta: Array, x: Array, lengths: Sequence[int]) -> ConditionedDynamics:
        """Return the dynamics of GPDM eq. (26)."""
        pairs = self._pairs(x, _Lags.of(lengths, self.order))
        return _ConditionedMarkov(self.order, self, self.process.condition(theta, *pairs))

    def properties(self, theta: Array, n_latent: int) -> dict[str, float]:
        """Return SNR(α) and CLS(α)."""
        scales = self.process.kernel.lengthscales(theta[:-1])
        ratio = self.process.signal_to_noise(theta, self.order * n_latent)
        return {"SNR(α)": ratio, **dict(zip(("CLS(α)", "CLS(α) of lag 2"), scales, strict=False))}


@dataclass(frozen=True)
class _ConditionedMarkov(ConditionedDynamics):
    order: int
    dynamics: Markov
    process: ConditionedProcess

    def negative_log_density(self, x: Array) -> tuple[float, Array]:
        lags = _Lags.of([len(x)], self.order)
        inputs, targets = self.dynamics._pairs(x, lags)
        visible = np.ones(len(targets), dtype=bool)
        value, d_inputs, d_targets = self.process.negative_log_density(inputs, targets, visible)
        value += 0.5 * float((x[lags.first] ** 2).sum())
        return value, self.dynamics._pull(x, lags, d_inputs, d_targets)

    def step(self, history: Array) -> tuple[Array, Array]:
        inputs = history.reshape(len(history), -1)
        mean, variance = self.process.marginals(inputs)
        return mean + self.dynamics.carry * history[:, 0], variance


@dataclass(frozen=True)
class Static(Dynamics, ConditionedDynamics):
    """Independent standard normal positions: the prior of the GPLVM, which ignores time."""

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

    def condition(self, theta: Array, x: Array, lengths: Sequence[int]) -> ConditionedDynamics:
        """Return itself: the positions of other sequences are independent of a new one's."""
        del theta, x, lengths
        return self

    def properties(self, theta: Array, n_latent: int) -> dict[str, float]:
        """Return no properties: there are no dynamics."""
        del theta, n_latent
        return {}

    def negative_log_density(self, x: Array) -> tuple[float, Array]:
        """Return ½‖x‖²."""
        return 0.5 * float((x**2).sum()), x

    def step(self, history: Array) -> tuple[Array, Array]:
        """Return mean 0 and variance 1, whatever the history."""
        return np.zeros_like(history[:, 0]), np.ones(len(history))
