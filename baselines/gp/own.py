r"""The outputs' own parts: :math:`E_d = \sum_\tau \kappa_{\tau d}\, U_\tau \otimes k_\tau + \nu_d`.

:math:`\tau` runs over the components of all layers, :math:`U_\tau` is the layer's Gram matrix over
units and :math:`\nu_d` the noise.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.block import Block
from mocapbench.baselines.gp.cholesky import invert
from mocapbench.baselines.gp.coregionalisation import Coregionalisation
from mocapbench.baselines.gp.kernels import Kernel
from mocapbench.baselines.gp.parameters import Layer, Parameters

__all__ = ["OwnPrecision", "own_gradient", "own_precision"]

Array = NDArray[np.float64]


class OwnPrecision(NamedTuple):
    """The inverses F_d = E_d⁻¹.

    Parameters
    ----------
    matrices : tuple of ndarray of shape (n_d, n_d)
        F_d over the visible entries of each output.
    grid : ndarray of shape (P, P, D, N, N)
        The same over all pairs of units and times, 0 at hidden ones.
    log_determinant : float
        Σ_d log|E_d|.
    """

    matrices: tuple[Array, ...]
    grid: Array
    log_determinant: float


def own_precision(kernel: Kernel, block: Block, parameters: Parameters) -> OwnPrecision:
    """Invert the covariance of every output's own part.

    Raises
    ------
    SingularCovarianceError
        If one is not numerically positive definite.
    """
    entries, matrices, log_determinant = block.entries, [], 0.0
    covariance, grid = _covariance(kernel, block, parameters), entries.zeros()
    noise = entries.pick((parameters.noise[:, None] * block.noise_scale)[..., None])
    for pairs, variances in zip(entries.pairs, noise, strict=True):
        own = covariance.take(pairs)
        own.reshape(-1)[:: len(own) + 1] += variances[:, 0]
        inverse, of_output = invert(own, parameters)
        matrices.append(inverse)
        grid.reshape(-1)[pairs] = inverse
        log_determinant += of_output
    return OwnPrecision(tuple(matrices), grid, log_determinant)


def own_gradient(kernel: Kernel, block: Block, parameters: Parameters, grid: Array) -> Parameters:
    """Return the gradient of a function whose gradient in E is ``grid`` (P, P, D, N, N)."""
    diagonal = np.einsum("ppdtt->pdt", grid)
    by_noise = parameters.noise * (diagonal * block.noise_scale).sum(axis=(0, 2))
    layers = {
        name: _layer_gradient(kernel, block, layer, np.tensordot(block.grams[name], grid))
        if name in block.units
        else layer.zeros()
        for name, layer in parameters.layers.items()
    }
    return Parameters(layers, by_noise)


def _layer_gradient(kernel: Kernel, block: Block, layer: Layer, summed: Array) -> Layer:
    """Return the gradient in one layer; ``summed`` (D, N, N) is the adjoint of Σ_q κ_qd k_q."""
    scales, b = layer.lengthscales[:, None, None], layer.coregionalisation
    by_kappa, by_log_lengthscale = (
        np.tensordot(derivative(block.lags, scales), summed, axes=((1, 2), (1, 2)))
        for derivative in (kernel.value, kernel.gradient)
    )
    return Layer(
        (b.kappa * by_log_lengthscale).sum(axis=1),
        Coregionalisation(np.zeros_like(b.weights), 2.0 * b.kappa_roots * by_kappa),
    )


def _covariance(kernel: Kernel, block: Block, parameters: Parameters) -> Array:
    """Return Σ_τ κ_τd U_τ ⊗ k_τ, a grid (P, P, D, N, N)."""
    layers = [(gram, parameters.layers[name]) for name, gram in block.grams.items()]
    kernels = np.concatenate(
        [kernel.value(block.lags, layer.lengthscales[:, None, None]) for _, layer in layers]
    )
    shares = np.concatenate(
        [np.multiply.outer(gram, layer.coregionalisation.kappa.T) for gram, layer in layers], axis=3
    )
    return np.tensordot(shares, kernels, axes=1)
