r"""Stationary kernels of unit variance.

Variance lives in the coregionalisation matrices, so a kernel has one parameter, its lengthscale
:math:`\ell`. A kernel is written as a function of the scaled lag :math:`a \propto |t - t'| / \ell`,
whence :math:`\partial k / \partial \log \ell = -a\, k'(a)`. Formulae: Rasmussen & Williams, §4.2.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

__all__ = ["KERNELS", "RBF", "Kernel", "Matern12", "Matern32", "Matern52"]

Array = NDArray[np.float64]


class Kernel(ABC):
    """A unit-variance kernel k(t − t'; ℓ)."""

    @abstractmethod
    def value(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return k; ``lags`` and ``lengthscale`` broadcast."""

    @abstractmethod
    def gradient(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return ∂k / ∂ log ℓ; ``lags`` and ``lengthscale`` broadcast."""


class RBF(Kernel):
    r"""Squared exponential, :math:`e^{-a^2/2}` with :math:`a = |t - t'| / \ell`."""

    def value(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return k."""
        return np.asarray(np.exp(-0.5 * (lags / lengthscale) ** 2))

    def gradient(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return ∂k / ∂ log ℓ."""
        square = (lags / lengthscale) ** 2
        return np.asarray(square * np.exp(-0.5 * square))


class Matern12(Kernel):
    r"""Exponential, :math:`e^{-a}` with :math:`a = |t - t'| / \ell`."""

    def value(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return k."""
        return np.asarray(np.exp(-np.abs(lags) / lengthscale))

    def gradient(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return ∂k / ∂ log ℓ."""
        a = np.abs(lags) / lengthscale
        return np.asarray(a * np.exp(-a))


class Matern32(Kernel):
    r"""Once differentiable, :math:`(1 + a) e^{-a}` with :math:`a = \sqrt 3 |t - t'| / \ell`."""

    def value(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return k."""
        a = np.sqrt(3.0) * np.abs(lags) / lengthscale
        return np.asarray((1.0 + a) * np.exp(-a))

    def gradient(self, lags: Array, lengthscale: float | Array) -> Array:
        """Return ∂k / ∂ log ℓ."""
        a = np.sqrt(3.0) * np.abs(lags) / lengthscale
        return np.asarray(a**2 * np.exp(-a))


class Matern52(Kernel):
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


KERNELS: Mapping[str, Kernel] = MappingProxyType(
    {"rbf": RBF(), "matern12": Matern12(), "matern32": Matern32(), "matern52": Matern52()}
)
"""The kernels by the name that models take."""
