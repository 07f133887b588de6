"""Covariance functions of latent positions, each with its reverse derivative.

A kernel takes the logarithms of its positive parameters and two sets of inputs, and returns the
covariance matrix with a pullback: from the slope of a scalar with respect to that matrix to its
slopes with respect to both inputs and the log-parameters. Sums and scalings of kernels pull back
through their parts, so that (7), (11), (12) and (18) are compositions.

An input is one latent position, or several side by side: the last ones first ("lags").
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["RBF", "Kernel", "Linear", "Pullback", "Scaled", "Sum"]

Array = NDArray[np.float64]
Pullback = Callable[[Array], tuple[Array, Array, Array]]


class Kernel(ABC):
    """A covariance function k(a, b) with positive parameters."""

    start: tuple[float, ...]
    """The parameters that learning starts from."""

    @abstractmethod
    def __call__(self, theta: Array, a: Array, b: Array) -> tuple[Array, Pullback]:
        """Return the matrix (n, m) of ``a`` (n, q) against ``b`` (m, q), and its pullback."""

    @abstractmethod
    def diagonal(self, theta: Array, a: Array) -> Array:
        """Return k(a_i, a_i), shape (n,)."""

    @abstractmethod
    def lengthscales(self, theta: Array) -> tuple[float, ...]:
        """Return the characteristic lengthscales: inverse square roots of the inverse widths."""


@dataclass(frozen=True)
class RBF(Kernel):
    r"""exp(−½ Σ_l w_l ‖a_l − b_l‖²), one inverse width w_l a lag."""

    n_lags: int = 1

    @property
    def start(self) -> tuple[float, ...]:  # type: ignore[override]
        """Widths of one."""
        return (1.0,) * self.n_lags

    def __call__(self, theta: Array, a: Array, b: Array) -> tuple[Array, Pullback]:
        """Return the matrix and its pullback."""
        widths = np.repeat(np.exp(theta), a.shape[1] // self.n_lags)
        left, right = a * widths, b * widths
        matrix = left @ b.T
        matrix -= 0.5 * (left * a).sum(axis=1)[:, None]
        matrix -= 0.5 * (right * b).sum(axis=1)
        np.exp(np.minimum(matrix, 0.0, out=matrix), out=matrix)

        def pull(slope: Array) -> tuple[Array, Array, Array]:
            slope = slope * matrix
            rows, columns = slope.sum(axis=1), slope.sum(axis=0)
            across = slope @ b
            da = across - rows[:, None] * a
            db = slope.T @ a - columns[:, None] * b
            # Σ slope ‖a − b‖² per coordinate, without another matrix of distances.
            spread = rows @ a**2 + columns @ b**2 - 2.0 * (a * across).sum(axis=0)
            return widths * da, widths * db, self._by_lag(-0.5 * widths * spread)

        return matrix, pull

    def _by_lag(self, slopes: Array) -> Array:
        return np.asarray(slopes.reshape(self.n_lags, -1).sum(axis=1))

    def diagonal(self, theta: Array, a: Array) -> Array:
        """Return ones."""
        del theta
        return np.ones(len(a))

    def lengthscales(self, theta: Array) -> tuple[float, ...]:
        """Return w_l^(−½)."""
        return tuple(map(float, np.exp(-0.5 * theta)))


@dataclass(frozen=True)
class Linear(Kernel):
    r"""Σ_l v_l a_lᵀ b_l, one variance v_l a lag."""

    n_lags: int = 1

    @property
    def start(self) -> tuple[float, ...]:  # type: ignore[override]
        """The paper's variances of 0.1."""
        return (0.1,) * self.n_lags

    def __call__(self, theta: Array, a: Array, b: Array) -> tuple[Array, Pullback]:
        """Return the matrix and its pullback."""
        variances = np.repeat(np.exp(theta), a.shape[1] // self.n_lags)
        weighted = a * variances

        def pull(slope: Array) -> tuple[Array, Array, Array]:
            across = slope @ b
            by_lag = (weighted * across).sum(axis=0).reshape(self.n_lags, -1).sum(axis=1)
            return variances * across, slope.T @ weighted, by_lag

        return weighted @ b.T, pull

    def diagonal(self, theta: Array, a: Array) -> Array:
        """Return Σ_l v_l ‖a_l‖²."""
        return np.asarray(a**2 @ np.repeat(np.exp(theta), a.shape[1] // self.n_lags))

    def lengthscales(self, theta: Array) -> tuple[float, ...]:
        """Return none: a linear function has no lengthscale."""
        del theta
        return ()


@dataclass(frozen=True)
class Scaled(Kernel):
    """s k(a, b): the scale first, then the parameters of k."""

    kernel: Kernel

    @property
    def start(self) -> tuple[float, ...]:  # type: ignore[override]
        """The paper's scale of 0.9."""
        return (0.9, *self.kernel.start)

    def __call__(self, theta: Array, a: Array, b: Array) -> tuple[Array, Pullback]:
        """Return the matrix and its pullback."""
        scale = np.exp(theta[0])
        matrix, pull_kernel = self.kernel(theta[1:], a, b)
        matrix = scale * matrix

        def pull(slope: Array) -> tuple[Array, Array, Array]:
            da, db, dtheta = pull_kernel(scale * slope)
            return da, db, np.concatenate([[(slope * matrix).sum()], dtheta])

        return matrix, pull

    def diagonal(self, theta: Array, a: Array) -> Array:
        """Return s k(a_i, a_i)."""
        return np.asarray(np.exp(theta[0]) * self.kernel.diagonal(theta[1:], a))

    def lengthscales(self, theta: Array) -> tuple[float, ...]:
        """Return those of k."""
        return self.kernel.lengthscales(theta[1:])


@dataclass(frozen=True)
class Sum(Kernel):
    """k₁(a, b) + k₂(a, b), with the parameters of both in this order."""

    first: Kernel
    second: Kernel

    @property
    def start(self) -> tuple[float, ...]:  # type: ignore[override]
        """Those of both."""
        return (*self.first.start, *self.second.start)

    def _parts(self, theta: Array) -> tuple[Array, Array]:
        n_first = len(self.first.start)
        return theta[:n_first], theta[n_first:]

    def __call__(self, theta: Array, a: Array, b: Array) -> tuple[Array, Pullback]:
        """Return the matrix and its pullback."""
        one, two = self._parts(theta)
        first, pull_first = self.first(one, a, b)
        second, pull_second = self.second(two, a, b)

        def pull(slope: Array) -> tuple[Array, Array, Array]:
            (da, db, d_one), (ea, eb, d_two) = pull_first(slope), pull_second(slope)
            return da + ea, db + eb, np.concatenate([d_one, d_two])

        return first + second, pull

    def diagonal(self, theta: Array, a: Array) -> Array:
        """Return the sum of both."""
        one, two = self._parts(theta)
        return self.first.diagonal(one, a) + self.second.diagonal(two, a)

    def lengthscales(self, theta: Array) -> tuple[float, ...]:
        """Return those of both."""
        one, two = self._parts(theta)
        return (*self.first.lengthscales(one), *self.second.lengthscales(two))
