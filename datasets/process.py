"""The toy process: a two-layer hierarchy of LMC Gaussian processes (thesis §5.1.1, eq. 16)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.recording import Frames, Recording

__all__ = ["Layer", "ToyProcess", "Weights", "draw_gaussian"]

Array = NDArray[np.float64]
Weights = Callable[[np.random.Generator, tuple[int, ...]], Array]
"""Draws the entries of W, of the shape asked for."""

_NUGGET = 1e-9


@dataclass(frozen=True, eq=False)
class Layer:
    """One layer: Σ_q B_q ⊗ k_q with unit-variance RBF kernels (thesis eq. 13).

    Parameters
    ----------
    coregionalisation : ndarray of shape (Q, D, D)
        The matrices B_q.
    lengthscales : ndarray of shape (Q,)
        One per component, in the unit of the times.
    """

    coregionalisation: Array
    lengthscales: Array

    @classmethod
    def random(
        cls,
        rng: np.random.Generator,
        n_outputs: int,
        n_components: int,
        variance: float,
        weights: Weights = np.random.Generator.standard_normal,
    ) -> Layer:
        """Draw B = W Wᵀ + diag(κ), scaled so that the mean marginal variance is ``variance``."""
        columns = weights(rng, (n_components, n_outputs, 1))
        kappa = rng.uniform(0.05, 0.2, (n_components, n_outputs))
        lengthscales = rng.uniform(0.5, 2.0, n_components)
        matrices = columns @ columns.transpose(0, 2, 1) + kappa[:, :, None] * np.eye(n_outputs)
        marginal = np.trace(matrices.sum(axis=0)) / n_outputs
        return cls(matrices * (variance / marginal), lengthscales)

    def covariance(self, times: Frames) -> Array:
        """Return the covariance at ``times`` (N,), outputs slowest: (D N, D N)."""
        lags = np.subtract.outer(times, times)
        kernels = np.exp(-0.5 * (lags / self.lengthscales[:, None, None]) ** 2)
        n = self.coregionalisation.shape[1] * len(times)
        covariance = np.einsum("qde,qst->dset", self.coregionalisation, kernels)
        return np.asarray(covariance.reshape(n, n))


@dataclass(frozen=True, eq=False)
class ToyProcess:
    """A generating process g ~ GP(0, K_g), f_r ~ GP(g, K_f), y_r = f_r + white noise.

    Parameters
    ----------
    parent, child : Layer
        K_g and K_f.
    noise : float
        Variance of the white noise added to every child.
    """

    parent: Layer
    child: Layer
    noise: float

    VERSION: ClassVar[int] = 1
    """Raised whenever the same seed would give other bytes."""

    @classmethod
    def random(
        cls,
        rng: np.random.Generator,
        *,
        n_outputs: int,
        noise: float,
        n_components: int = 3,
        weights: Weights = np.random.Generator.standard_normal,
    ) -> ToyProcess:
        """Draw the layers of thesis §5.1.1: mean marginal variance 1 (parent) and 0.25 (child).

        ``weights=np.random.Generator.random`` draws W from U(0, 1), which correlates the outputs
        more (thesis §5.2.1).
        """
        parent = Layer.random(rng, n_outputs, n_components, 1.0, weights)
        return cls(parent, Layer.random(rng, n_outputs, n_components, 0.25, weights), noise)

    @property
    def n_outputs(self) -> int:
        """Number of outputs D."""
        return int(self.parent.coregionalisation.shape[1])

    def covariance(self, times: Frames) -> Array:
        """Return the covariance of one child's observations, outputs slowest: (D N, D N)."""
        signal = self.parent.covariance(times) + self.child.covariance(times)
        return signal + self.noise * np.eye(len(signal))

    def draw(
        self, rng: np.random.Generator, times: Frames, n_replicates: int
    ) -> tuple[Recording, ...]:
        """Draw children ``child-1`` … of one new parent, at ``times`` (N,), noise included."""
        parent = draw_gaussian(rng, self.parent.covariance(times), 1)
        deviations = draw_gaussian(rng, self.child.covariance(times), n_replicates)
        noise = np.sqrt(self.noise) * rng.standard_normal(deviations.shape)
        curves = (parent + deviations + noise).reshape(n_replicates, self.n_outputs, len(times))
        channels = tuple(f"output-{d + 1}" for d in range(self.n_outputs))
        return tuple(
            Recording(f"child-{r + 1}", times, curve.T, channels, ("",) * self.n_outputs)
            for r, curve in enumerate(curves)
        )


def draw_gaussian(rng: np.random.Generator, covariance: Array, n: int) -> Array:
    """Return n draws (n, d) of a Gaussian of zero mean.

    By the symmetric root, which exists where RBF's Cholesky factor does not. It is unique,
    unlike the eigenvectors, and the nugget keeps its rounding error below 1e-9, so that other
    LAPACK builds draw the same numbers.
    """
    eigenvalues, vectors = np.linalg.eigh(covariance)
    root = (vectors * np.sqrt(np.clip(eigenvalues, 0.0, None) + _NUGGET)) @ vectors.T
    return np.asarray(rng.standard_normal((n, len(covariance))) @ root)
