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

from mocapbench.baselines.gpdm.kernels import LatentKernel
from mocapbench.baselines.gpdm.regression import (
    ConditionedProcess,
    condition_process,
    log_start,
    negative_log_likelihood,
    signal_to_noise,
)
from mocapbench.basics.arrays import Array, Index

__all__ = ["ConditionedDynamics", "Dynamics", "Markov", "Static"]

_Lags = tuple[Index, Index, Index]
"""Rows of stacked sequences: positions (P,) with enough predecessors, these (P, order), the last
one first, and positions without as many."""


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
class Markov(Dynamics):
    r"""x_t − c x_{t−1} = f(x_{t−1}, …, x_{t−order}) + noise, f a Gaussian process.

    Parameters
    ----------
    kernel : LatentKernel
        The covariance of f; noise is added.
    order : int, default=1
        Number of previous positions on which the next one depends.
    carry : float, default=0.0
        The factor c: 0 predicts the position, 1 the step (velocity prediction, GPDM eq. 19).
    """

    kernel: LatentKernel
    order: int = 1
    carry: float = 0.0

    @property
    def start(self) -> Array:
        """The start of the process."""
        return log_start(self.kernel)

    def _pairs(self, x: Array, lags: _Lags) -> tuple[Array, Array]:
        now, before, _ = lags
        inputs = x[before].reshape(len(now), self.order * x.shape[1])
        return inputs, x[now] - self.carry * x[before[:, 0]]

    def _pull(self, x: Array, lags: _Lags, d_inputs: Array, d_targets: Array) -> Array:
        """Return the gradient (N, d) in x, given those in the pairs of inputs and targets.

        The first positions of a sequence have a standard normal prior, whose gradient is added.
        """
        (now, before, first), gradient = lags, np.zeros_like(x)
        by_lag = d_inputs.reshape(len(now), self.order, x.shape[1])
        for lag in range(self.order):
            gradient[before[:, lag]] += by_lag[:, lag]
        gradient[now] += d_targets
        gradient[before[:, 0]] -= self.carry * d_targets
        gradient[first] += x[first]
        return gradient

    def negative_log_prior(
        self, theta: Array, x: Array, lengths: Sequence[int]
    ) -> tuple[float, Array, Array]:
        """Return GPDM eq. (29) and its gradients."""
        lags = _relate_lags(lengths, self.order)
        value, gradients = negative_log_likelihood(self.kernel, theta, *self._pairs(x, lags))
        d_inputs, d_targets, d_theta = gradients
        return value + _first_term(x, lags), self._pull(x, lags, d_inputs, d_targets), d_theta

    def condition(self, theta: Array, x: Array, lengths: Sequence[int]) -> ConditionedDynamics:
        """Return the dynamics of GPDM eq. (26)."""
        pairs = self._pairs(x, _relate_lags(lengths, self.order))
        process = condition_process(self.kernel, theta, *pairs)
        return _ConditionedMarkov(self.order, self, process)

    def properties(self, theta: Array, n_latent: int) -> dict[str, float]:
        """Return SNR(α) and CLS(α)."""
        scales = self.kernel.lengthscales(theta[:-1])
        ratio = signal_to_noise(self.kernel, theta, self.order * n_latent)
        return {"SNR(α)": ratio, **dict(zip(("CLS(α)", "CLS(α) of lag 2"), scales, strict=False))}


@dataclass(frozen=True)
class _ConditionedMarkov(ConditionedDynamics):
    order: int
    dynamics: Markov
    process: ConditionedProcess

    def negative_log_density(self, x: Array) -> tuple[float, Array]:
        lags = _relate_lags([len(x)], self.order)
        inputs, targets = self.dynamics._pairs(x, lags)
        visible = np.ones(len(targets), dtype=bool)
        value, d_inputs, d_targets = self.process.negative_log_density(inputs, targets, visible)
        return value + _first_term(x, lags), self.dynamics._pull(x, lags, d_inputs, d_targets)

    def step(self, history: Array) -> tuple[Array, Array]:
        inputs = history.reshape(len(history), -1)
        mean, variance = self.process.marginals(inputs)
        return mean + self.dynamics.carry * history[:, 0], variance


class Static(Dynamics, ConditionedDynamics):
    """Independent standard normal positions: the prior of the GPLVM, which ignores time."""

    order = 1

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


def _relate_lags(lengths: Sequence[int], order: int) -> _Lags:
    """Return the rows of stacked sequences that dynamics of an order relate."""
    frames = np.concatenate([np.arange(length) for length in lengths])
    rows = np.arange(len(frames))
    now = rows[frames >= order]
    return now, now[:, None] - np.arange(1, order + 1), rows[frames < order]


def _first_term(x: Array, lags: _Lags) -> float:
    """Return −ln of the standard normal prior of the first positions, constants left out."""
    _, _, first = lags
    return 0.5 * float((x[first] ** 2).sum())
