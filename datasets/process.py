"""The toy process: a hierarchy of Gaussian processes with one parent and several children.

Each of its two layers is a linear model of coregionalisation (LMC). After J. D. Gil López,
*Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc thesis, Universidad
Tecnológica de Pereira, 2017 (thesis), §5.1.1, eq. 16.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.datasets.recording import Frames, Recording

__all__ = ["Layer", "ToyProcess", "Weights", "draw_gaussian", "normal_weights", "uniform_weights"]


Weights = Callable[[np.random.Generator, tuple[int, ...]], Array]
"""From a random generator and a shape to the entries of the factors W."""

_NUGGET = 1e-9


def normal_weights(rng: np.random.Generator, shape: tuple[int, ...]) -> Array:
    """Draw standard normal weights."""
    return rng.standard_normal(shape)


def uniform_weights(rng: np.random.Generator, shape: tuple[int, ...]) -> Array:
    """Draw weights from [0, 1]: all outputs correlate positively (thesis §5.2.1, §5.2.3)."""
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
        """Return the covariance (D N, D N) at ``times`` (N,), ordered by output and then time."""
        lags = np.subtract.outer(times, times)
        kernels = np.exp(-0.5 * (lags / self.lengthscales[:, None, None]) ** 2)
        n = self.coregionalisation.shape[1] * len(times)
        covariance = np.einsum("qde,qst->dset", self.coregionalisation, kernels)
        return np.asarray(covariance.reshape(n, n))


@dataclass(frozen=True, eq=False)
class ToyProcess:
    """A parent g ~ GP(0, K_g), its children f_r ~ GP(g, K_f), and their observations with noise.

    Parameters
    ----------
    parent, child : Layer
        K_g and K_f.
    noise : float
        Variance of the white noise added to every child.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.datasets import ToyProcess
    >>> rng = np.random.default_rng(0)
    >>> process = ToyProcess.random(rng, n_outputs=2, noise=0.01)
    >>> times = np.linspace(0.0, 6.0, 20)
    >>> children = process.draw(rng, times, n_replicates=3)
    >>> [child.name for child in children]
    ['child-1', 'child-2', 'child-3']
    >>> children[0].values.shape
    (20, 2)
    >>> process.covariance(times).shape
    (40, 40)
    """

    parent: Layer
    child: Layer
    noise: float

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
        """Draw the layers as in thesis §5.1.1.

        Their mean marginal variances are 1 (parent) and 0.25 (child).

        Parameters
        ----------
        rng : Generator
            Source of randomness.
        n_outputs : int
            Number of outputs D.
        noise : float
            Variance of the white noise added to every child.
        n_components : int
            Number of components Q of each layer.
        draw_weights : callable
            Draws the factors W of the coregionalisation matrices.
        """
        parent = Layer.random(rng, n_outputs, n_components, 1.0, draw_weights)
        child = Layer.random(rng, n_outputs, n_components, 0.25, draw_weights)
        return cls(parent, child, noise)

    @property
    def n_outputs(self) -> int:
        """Number of outputs D."""
        return int(self.parent.coregionalisation.shape[1])

    def covariance(self, times: Frames) -> Array:
        """Return the covariance (D N, D N) of one child's observations, by output and then time."""
        signal = self.parent.covariance(times) + self.child.covariance(times)
        return signal + self.noise * np.eye(len(signal))

    def draw(
        self, rng: np.random.Generator, times: Frames, n_replicates: int
    ) -> tuple[Recording, ...]:
        """Draw children of one new parent, noise included.

        Parameters
        ----------
        rng : Generator
            Source of randomness.
        times : ndarray of shape (N,)
            Strictly increasing times.
        n_replicates : int
            Number of children.

        Returns
        -------
        tuple of Recording
            Named ``child-1``, ``child-2`` and so on, with channels ``output-1``, ``output-2`` ….
        """
        return self.draw_family(rng, times, n_replicates)[1]

    def draw_family(
        self, rng: np.random.Generator, times: Frames, n_replicates: int
    ) -> tuple[Recording, tuple[Recording, ...]]:
        """Draw a new parent and its children, the same as `draw` from the same generator.

        Returns
        -------
        parent : Recording
            Named ``parent``, without noise.
        children : tuple of Recording
            As from `draw`.
        """
        parent = draw_gaussian(rng, self.parent.covariance(times), 1)
        deviations = draw_gaussian(rng, self.child.covariance(times), n_replicates)
        noise = np.sqrt(self.noise) * rng.standard_normal(deviations.shape)
        names = [f"child-{r + 1}" for r in range(n_replicates)]
        children = zip(names, parent + deviations + noise, strict=True)
        return self._recording("parent", parent[0], times), tuple(
            self._recording(name, curve, times) for name, curve in children
        )

    def _recording(self, name: str, curve: Array, times: Frames) -> Recording:
        """Return a curve (D N,), ordered by output and then by time, as a recording."""
        channels = tuple(f"output-{d + 1}" for d in range(self.n_outputs))
        values = curve.reshape(self.n_outputs, len(times)).T
        return Recording(name, times, values, channels, ("",) * self.n_outputs)


def draw_gaussian(rng: np.random.Generator, covariance: Array, n: int) -> Array:
    """Return n draws (n, d) of a Gaussian of zero mean.

    By the symmetric square root, which exists even where rounding makes the Cholesky decomposition
    of an RBF covariance fail. Unlike the eigenvectors it is unique, and the nugget keeps its
    rounding error below 1e-9, so that other LAPACK builds draw the same numbers.
    """
    eigenvalues, vectors = np.linalg.eigh(covariance)
    root = (vectors * np.sqrt(np.clip(eigenvalues, 0.0, None) + _NUGGET)) @ vectors.T
    return np.asarray(rng.standard_normal((n, len(covariance))) @ root)
