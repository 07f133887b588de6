"""The toy process: a two-layer hierarchy of LMC Gaussian processes (thesis §5.1.1, eq. 16)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.recording import Frames, Recording

__all__ = ["Layer", "ToyProcess", "Weights", "draw_gaussian", "normal_weights", "uniform_weights"]

Array = NDArray[np.float64]

Weights = Callable[[np.random.Generator, tuple[int, ...]], Array]
"""From a generator and a shape to random entries of the factors W."""

_NUGGET = 1e-9


def normal_weights(rng: np.random.Generator, shape: tuple[int, ...]) -> Array:
    """Draw standard normal weights."""
    return rng.standard_normal(shape)


def uniform_weights(rng: np.random.Generator, shape: tuple[int, ...]) -> Array:
    """Draw weights from [0, 1], which all correlate positively (thesis §5.2.1, §5.2.3)."""
    return rng.uniform(0.0, 1.0, shape)


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
        draw_weights: Weights = normal_weights,
    ) -> Layer:
        """Draw B = W Wᵀ + diag(κ), scaled so that the mean marginal variance is ``variance``."""
        weights = draw_weights(rng, (n_components, n_outputs, 1))
        kappa = rng.uniform(0.05, 0.2, (n_components, n_outputs))
        lengthscales = rng.uniform(0.5, 2.0, n_components)
        matrices = weights @ weights.transpose(0, 2, 1) + kappa[:, :, None] * np.eye(n_outputs)
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
        draw_weights: Weights = normal_weights,
    ) -> ToyProcess:
        """Draw the layers of thesis §5.1.1: mean marginal variance 1 (parent) and 0.25 (child)."""
        parent = Layer.random(rng, n_outputs, n_components, 1.0, draw_weights)
        child = Layer.random(rng, n_outputs, n_components, 0.25, draw_weights)
        return cls(parent, child, noise)

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
        return self.draw_family(rng, times, n_replicates)[1]

    def draw_family(
        self, rng: np.random.Generator, times: Frames, n_replicates: int
    ) -> tuple[Recording, tuple[Recording, ...]]:
        """Draw a new ``parent``, and its children as `draw` gives them from the same generator."""
        parent = draw_gaussian(rng, self.parent.covariance(times), 1)
        deviations = draw_gaussian(rng, self.child.covariance(times), n_replicates)
        noise = np.sqrt(self.noise) * rng.standard_normal(deviations.shape)
        names = [f"child-{r + 1}" for r in range(n_replicates)]
        children = zip(names, parent + deviations + noise, strict=True)
        return self._recording("parent", parent[0], times), tuple(
            self._recording(name, curve, times) for name, curve in children
        )

    def _recording(self, name: str, curve: Array, times: Frames) -> Recording:
        """Return a curve (D N,), outputs slowest, as a recording."""
        channels = tuple(f"output-{d + 1}" for d in range(self.n_outputs))
        values = curve.reshape(self.n_outputs, len(times)).T
        return Recording(name, times, values, channels, ("",) * self.n_outputs)


def draw_gaussian(rng: np.random.Generator, covariance: Array, n: int) -> Array:
    """Return n draws (n, d) of a Gaussian of zero mean.

    By the symmetric root, which exists where RBF's Cholesky factor does not. It is unique,
    unlike the eigenvectors, and the nugget keeps its rounding error below 1e-9, so that other
    LAPACK builds draw the same numbers.
    """
    eigenvalues, vectors = np.linalg.eigh(covariance)
    root = (vectors * np.sqrt(np.clip(eigenvalues, 0.0, None) + _NUGGET)) @ vectors.T
    return np.asarray(rng.standard_normal((n, len(covariance))) @ root)
