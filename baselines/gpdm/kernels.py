"""Covariance functions of latent positions, each with its reverse-mode derivative.

A kernel takes the logarithms of its positive parameters and two sets of inputs. It returns the
covariance matrix and a pullback: a function from the gradient of a scalar with respect to that
matrix to its gradients with respect to both inputs and to the log-parameters. Sums and scaled
kernels call the pullbacks of their parts, so that GPDM eq. (7), (11), (12) and (18) are
compositions.

An input is one latent position, or several side by side ("lags"), the last one first.

Wang, Fleet and Hertzmann (2008), *Gaussian Process Dynamical Models for Human Motion*, IEEE TPAMI
30(2), is cited as GPDM.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mocapbench.basics.arrays import Array

__all__ = ["LatentKernel", "LinearKernel", "Pullback", "RBFKernel", "ScaledKernel", "SumKernel"]

Pullback = Callable[[Array], tuple[Array, Array, Array]]


class LatentKernel(ABC):
    """A covariance function k(a, b) with positive parameters."""

    start: tuple[float, ...]
    """The parameters from which learning starts."""

    @abstractmethod
    def __call__(self, theta: Array, a: Array, b: Array) -> tuple[Array, Pullback]:
        """Return the covariances (n, m) of ``a`` (n, q) with ``b`` (m, q), and the pullback."""

    @abstractmethod
    def diagonal(self, theta: Array, a: Array) -> Array:
        """Return k(a_i, a_i), shape (n,)."""

    @abstractmethod
    def lengthscales(self, theta: Array) -> tuple[float, ...]:
        """Return the characteristic lengthscales, w^(−½) for each inverse width w."""


@dataclass(frozen=True)
class LaggedKernel(LatentKernel):
    """A kernel with one parameter for each of the positions that are side by side in an input."""

    n_lags: int = 1

    def _by_coordinate(self, theta: Array, a: Array) -> Array:
        """Return the parameter of each coordinate of inputs (n, q), (q,)."""
        return np.repeat(np.exp(theta), a.shape[1] // self.n_lags)

    def _by_lag(self, gradients: Array) -> Array:
        """Return the sums (n_lags,) of gradients by coordinate (q,)."""
        return np.asarray(gradients.reshape(self.n_lags, -1).sum(axis=1))


class RBFKernel(LaggedKernel):
    r"""exp(−½ Σ_l w_l ‖a_l − b_l‖²), with one inverse width w_l for each lag l."""

    @property
    def start(self) -> tuple[float, ...]:  # type: ignore[override]
        """Inverse widths of 1."""
        return (1.0,) * self.n_lags

    def __call__(self, theta: Array, a: Array, b: Array) -> tuple[Array, Pullback]:
        """Return the matrix and its pullback."""
        widths = self._by_coordinate(theta, a)
        # aᵀ W b − ½ aᵀ W a − ½ bᵀ W b, at most 0.
        left, right = a * widths, b * widths
        matrix = left @ b.T
        matrix -= 0.5 * (left * a).sum(axis=1)[:, None]
        matrix -= 0.5 * (right * b).sum(axis=1)
        np.exp(np.minimum(matrix, 0.0, out=matrix), out=matrix)

        def pull(gradient: Array) -> tuple[Array, Array, Array]:
            gradient = gradient * matrix
            rows, columns = gradient.sum(axis=1), gradient.sum(axis=0)
            across = gradient @ b
            da = across - rows[:, None] * a
            db = gradient.T @ a - columns[:, None] * b
            # Σ gradient (a − b)² for each coordinate, without another (n, m) matrix.
            distances = rows @ a**2 + columns @ b**2 - 2.0 * (a * across).sum(axis=0)
            return widths * da, widths * db, self._by_lag(-0.5 * widths * distances)

        return matrix, pull

    def diagonal(self, theta: Array, a: Array) -> Array:
        """Return ones."""
        del theta
        return np.ones(len(a))

    def lengthscales(self, theta: Array) -> tuple[float, ...]:
        """Return w_l^(−½)."""
        return tuple(map(float, np.exp(-0.5 * theta)))


class LinearKernel(LaggedKernel):
    r"""Σ_l v_l a_lᵀ b_l, with one variance v_l for each lag l."""

    @property
    def start(self) -> tuple[float, ...]:  # type: ignore[override]
        """The paper's variances of 0.1."""
        return (0.1,) * self.n_lags

    def __call__(self, theta: Array, a: Array, b: Array) -> tuple[Array, Pullback]:
        """Return the matrix and its pullback."""
        variances = self._by_coordinate(theta, a)
        weighted = a * variances

        def pull(gradient: Array) -> tuple[Array, Array, Array]:
            across = gradient @ b
            d_theta = self._by_lag((weighted * across).sum(axis=0))
            return variances * across, gradient.T @ weighted, d_theta

        return weighted @ b.T, pull

    def diagonal(self, theta: Array, a: Array) -> Array:
        """Return Σ_l v_l ‖a_l‖²."""
        return np.asarray(a**2 @ self._by_coordinate(theta, a))

    def lengthscales(self, theta: Array) -> tuple[float, ...]:
        """Return an empty tuple: a linear function has no lengthscale."""
        del theta
        return ()


@dataclass(frozen=True)
class ScaledKernel(LatentKernel):
    """s k(a, b); the parameters are the scale s and then those of k."""

    kernel: LatentKernel

    @property
    def start(self) -> tuple[float, ...]:  # type: ignore[override]
        """The paper's scale of 0.9."""
        return (0.9, *self.kernel.start)

    def __call__(self, theta: Array, a: Array, b: Array) -> tuple[Array, Pullback]:
        """Return the matrix and its pullback."""
        scale = np.exp(theta[0])
        matrix, pull_kernel = self.kernel(theta[1:], a, b)
        matrix = scale * matrix

        def pull(gradient: Array) -> tuple[Array, Array, Array]:
            da, db, dtheta = pull_kernel(scale * gradient)
            return da, db, np.concatenate([[(gradient * matrix).sum()], dtheta])

        return matrix, pull

    def diagonal(self, theta: Array, a: Array) -> Array:
        """Return s k(a_i, a_i)."""
        return np.asarray(np.exp(theta[0]) * self.kernel.diagonal(theta[1:], a))

    def lengthscales(self, theta: Array) -> tuple[float, ...]:
        """Return the lengthscales of k."""
        return self.kernel.lengthscales(theta[1:])


@dataclass(frozen=True)
class SumKernel(LatentKernel):
    """k₁(a, b) + k₂(a, b); the parameters are those of k₁ and then those of k₂."""

    first: LatentKernel
    second: LatentKernel

    @property
    def start(self) -> tuple[float, ...]:  # type: ignore[override]
        """The start of k₁ and then that of k₂."""
        return (*self.first.start, *self.second.start)

    def _parts(self, theta: Array) -> tuple[Array, Array]:
        n_first = len(self.first.start)
        return theta[:n_first], theta[n_first:]

    def __call__(self, theta: Array, a: Array, b: Array) -> tuple[Array, Pullback]:
        """Return the matrix and its pullback."""
        one, two = self._parts(theta)
        first, pull_first = self.first(one, a, b)
        second, pull_second = self.second(two, a, b)

        def pull(gradient: Array) -> tuple[Array, Array, Array]:
            (da, db, d_one), (ea, eb, d_two) = pull_first(gradient), pull_second(gradient)
            return da + ea, db + eb, np.concatenate([d_one, d_two])

        return first + second, pull

    def diagonal(self, theta: Array, a: Array) -> Array:
        """Return k₁(a_i, a_i) + k₂(a_i, a_i)."""
        one, two = self._parts(theta)
        return self.first.diagonal(one, a) + self.second.diagonal(two, a)

    def lengthscales(self, theta: Array) -> tuple[float, ...]:
        """Return the lengthscales of both."""
        one, two = self._parts(theta)
        return (*self.first.lengthscales(one), *self.second.lengthscales(two))
