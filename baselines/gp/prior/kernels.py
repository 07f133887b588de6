r"""Stationary kernels of unit variance.

Variances are in the coregionalisation matrices, so a kernel has one parameter, its lengthscale
:math:`\ell`. As a function of the scaled lag :math:`a \propto |t - t'| / \ell` its derivative is
:math:`\partial k / \partial \log \ell = -a\, k'(a)`. The formulae are those of Rasmussen and
Williams (2006), *Gaussian Processes for Machine Learning*, §4.2.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from mocapbench.basics.arrays import Array

__all__ = ["KERNELS", "RBF", "Matern12", "Matern32", "Matern52", "StationaryKernel"]


class StationaryKernel(ABC):
    """A unit-variance kernel k(t − t'; ℓ)."""

    @abstractmethod
    def value(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return k; ``lags`` and ``lengthscale`` broadcast."""

    @abstractmethod
    def gradient(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return ∂k / ∂ log ℓ; ``lags`` and ``lengthscale`` broadcast."""


class RBF(StationaryKernel):
    r"""Squared exponential, :math:`e^{-a^2/2}` with :math:`a = |t - t'| / \ell`."""

    def value(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return k."""
        return np.asarray(np.exp(-0.5 * (lags / lengthscale) ** 2))

    def gradient(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return ∂k / ∂ log ℓ."""
        square = (lags / lengthscale) ** 2
        return np.asarray(square * np.exp(-0.5 * square))


class Matern12(StationaryKernel):
    r"""Exponential, :math:`e^{-a}` with :math:`a = |t - t'| / \ell`."""

    def value(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return k."""
        return np.asarray(np.exp(-np.abs(lags) / lengthscale))

    def gradient(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return ∂k / ∂ log ℓ."""
        a = np.abs(lags) / lengthscale
        return np.asarray(a * np.exp(-a))


class Matern32(StationaryKernel):
    r"""Once differentiable, :math:`(1 + a) e^{-a}` with :math:`a = \sqrt 3 |t - t'| / \ell`."""

    def value(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return k."""
        a = np.sqrt(3.0) * np.abs(lags) / lengthscale
        return np.asarray((1.0 + a) * np.exp(-a))

    def gradient(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return ∂k / ∂ log ℓ."""
        a = np.sqrt(3.0) * np.abs(lags) / lengthscale
        return np.asarray(a**2 * np.exp(-a))


class Matern52(StationaryKernel):
    r"""Twice differentiable.

    :math:`(1 + a + a^2 / 3) e^{-a}` with :math:`a = \sqrt 5 |t - t'| / \ell`.
    """

    def value(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return k."""
        a = np.sqrt(5.0) * np.abs(lags) / lengthscale
        return np.asarray((1.0 + a + a**2 / 3.0) * np.exp(-a))

    def gradient(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return ∂k / ∂ log ℓ."""
        a = np.sqrt(5.0) * np.abs(lags) / lengthscale
        return np.asarray(a**2 * (1.0 + a) / 3.0 * np.exp(-a))


KERNELS: Mapping[str, StationaryKernel] = MappingProxyType(
    {"rbf": RBF(), "matern12": Matern12(), "matern32": Matern32(), "matern52": Matern52()}
)
"""The kernels by the name that models take."""
