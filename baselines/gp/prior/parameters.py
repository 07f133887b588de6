"""The parameters of a model, by name and as one vector of free coordinates.

A layer ("parent" g, "child" f − g) is a linear model of coregionalisation, Σ_q B_q ⊗ k_q with
B_q = W_q W_qᵀ + diag(κ_q) (eq. 15 and 17 of J. D. Gil López, *Hierarchical Multiple Output Gaussian
Processes for Human Motion Data*, MSc thesis, Universidad Tecnológica de Pereira, 2017), and every
output has a noise variance. The optimiser works on one flat vector of log ℓ, W, the *signed root*
√κ and log β (docs/mathematics/prediction.md, section 10). With the root it can reach, and leave,
κ = 0; with log κ it would approach that value ever more slowly. A gradient is a `Parameters` too:
its entries are the derivatives in the free coordinates.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.basics.arrays import Array

__all__ = ["CHILD", "PARENT", "LayerParameters", "Parameters"]


PARENT = "parent"
"""Name of the layer g, the draw of which all replicates share."""
CHILD = "child"
"""Name of the layer f − g, of which every replicate has an independent draw."""
JITTER = 1e-10
"""Variance added to a kernel matrix that is drawn from, relative to the kernel's. Rounding leaves
the smallest eigenvalues of a smooth kernel below zero by some 1e-14."""


@dataclass(frozen=True, eq=False)
class LayerParameters:
    """One linear model of coregionalisation, Σ_q B_q ⊗ k_q.

    Parameters
    ----------
    log_lengthscales : ndarray of shape (Q,)
        One per component.
    weights : ndarray of shape (Q, D, rank)
        The factors W_q; with rank 0 the matrices B_q are diagonal.
    kappa_roots : ndarray of shape (Q, D)
        Signed roots of κ_q.
    """

    log_lengthscales: Array
    weights: Array
    kappa_roots: Array

    @property
    def lengthscales(self) -> Array:
        """(Q,) lengthscales in the unit of the times."""
        return np.exp(self.log_lengthscales)

    @property
    def kappa(self) -> Array:
        """(Q, D) variances κ_q, which are not shared between outputs."""
        return self.kappa_roots**2

    @property
    def matrices(self) -> Array:
        """(Q, D, D) the matrices B_q."""
        shared = self.weights @ self.weights.transpose(0, 2, 1)
        return shared + self.kappa[:, :, None] * np.eye(self.kappa.shape[1])

    @property
    def variances(self) -> Array:
        """(D,) marginal variance of each output, Σ_q diag B_q."""
        return np.asarray((self.weights**2).sum(axis=(0, 2)) + self.kappa.sum(axis=0))

    @property
    def leaves(self) -> tuple[Array, Array, Array]:
        """The free coordinates: log ℓ, W, √κ."""
        return self.log_lengthscales, self.weights, self.kappa_roots

    def covariance(self, kernel: StationaryKernel, lags: Array) -> Array:
        """Return Σ_q B_q ⊗ k_q for ``lags`` (M, N), (D, M, D, N)."""
        matrices = self.matrices
        n_components, n_outputs, _ = matrices.shape
        kernels = kernel.value(lags, self.lengthscales[:, None, None])
        by_pair = matrices.reshape(n_components, -1).T @ kernels.reshape(n_components, -1)
        return by_pair.reshape(n_outputs, n_outputs, *lags.shape).transpose(0, 2, 1, 3)

    def draw(
        self, kernel: StationaryKernel, times: Array, n_samples: int, rng: np.random.Generator
    ) -> Array:
        """Return (n_samples, M, D) draws of Σ_q B_q ⊗ k_q at ``times`` (M,).

        The covariance is not formed: a draw of a component is white noise multiplied by L in time,
        k_q = L Lᵀ, and by [W, √diag κ] in outputs (docs/mathematics/prediction.md, section 9).
        Equal times get equal values. Rounding, which differs among processors, changes draws by
        little: the Cholesky factor is continuous in the matrix, and the roots of κ count without
        their sign.
        """
        grid, places = np.unique(times, return_inverse=True)
        total = np.zeros((n_samples, len(grid), self.kappa_roots.shape[1]))
        components = zip(self.lengthscales, self.weights, self.kappa_roots, strict=True)
        for lengthscale, columns, kappa_roots in components:
            gram = kernel.value(np.subtract.outer(grid, grid), float(lengthscale))
            root = np.linalg.cholesky(gram + JITTER * np.eye(len(grid)))
            mixing = np.hstack([columns, np.diag(np.abs(kappa_roots))])
            white = rng.standard_normal((n_samples, len(grid), mixing.shape[1]))
            total += root @ white @ mixing.T
        return total[:, places]

    def zeros(self) -> LayerParameters:
        """Return the layer of the same shapes whose free coordinates are all 0."""
        return LayerParameters(*map(np.zeros_like, self.leaves))

    def pull_back(self, log_lengthscales: Array, adjoint: Array) -> LayerParameters:
        """Return the gradient of a function, given those in log ℓ and in the matrices B_q.

        Parameters
        ----------
        log_lengthscales : ndarray of shape (Q,)
            Derivatives in log ℓ.
        adjoint : ndarray of shape (Q, D, D)
            Derivatives with respect to the entries of B_q taken one by one. Its antisymmetric
            part has no effect, since B_q is symmetric.
        """
        # ∂W = (B̄ + B̄ᵀ) W and ∂√κ = 2 √κ diag B̄.
        diagonal = np.diagonal(adjoint, axis1=1, axis2=2)
        return LayerParameters(
            log_lengthscales,
            (adjoint + adjoint.transpose(0, 2, 1)) @ self.weights,
            2.0 * self.kappa_roots * diagonal,
        )


@dataclass(frozen=True, eq=False)
class Parameters:
    """All parameters of a model, or a gradient with respect to them.

    Parameters
    ----------
    layers : mapping of str to LayerParameters
        By name: `PARENT`, `CHILD`, and groups of replicates in between.
    log_noise : ndarray of shape (D,)
        log β_d, the noise variance of each output.
    """

    layers: Mapping[str, LayerParameters]
    log_noise: Array

    @property
    def noise(self) -> Array:
        """(D,) noise variances β_d."""
        return np.exp(self.log_noise)

    @property
    def leaves(self) -> tuple[Array, ...]:
        """The free coordinates in the order of `flat`."""
        return (*(leaf for layer in self.layers.values() for leaf in layer.leaves), self.log_noise)

    @property
    def flat(self) -> Array:
        """(n_parameters,) all free coordinates as one vector."""
        return np.concatenate([leaf.ravel() for leaf in self.leaves])

    @property
    def shapes(self) -> Mapping[str, tuple[int, int, int]]:
        """(Q, D, rank) of each layer."""
        return {name: layer.weights.shape for name, layer in self.layers.items()}

    def at(self, flat: Array) -> Parameters:
        """Return the parameters of the same shapes whose `flat` is the given vector."""
        ends = np.cumsum([leaf.size for leaf in self.leaves])[:-1]
        pieces = np.split(np.asarray(flat, dtype=np.float64), ends)
        *layers, log_noise = (
            piece.reshape(leaf.shape) for piece, leaf in zip(pieces, self.leaves, strict=True)
        )
        triples = zip(layers[::3], layers[1::3], layers[2::3], strict=True)
        by_name = zip(self.layers, triples, strict=True)
        return Parameters({name: LayerParameters(*leaves) for name, leaves in by_name}, log_noise)

    def __str__(self) -> str:
        scales = ", ".join(
            f"{name} lengthscales {np.array2string(layer.lengthscales, precision=3)}"
            for name, layer in self.layers.items()
        )
        return f"{scales}, noise variances {self.noise.min():.3g} to {self.noise.max():.3g}"
