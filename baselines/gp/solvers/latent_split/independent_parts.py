r"""The independent part of each output.

:math:`E_d = \sum_\tau \kappa_{\tau d}\, U_\tau \otimes k_\tau + \nu_d`, where :math:`\tau` runs
over the components of all layers, :math:`U_\tau` is the layer's Gram matrix over units and
:math:`\nu_d` the noise (docs/mathematics/solvers.md, section 5). There is one matrix for each
output, over the m rows of the block.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mocapbench.baselines.common.cholesky import invert
from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import LayerParameters, Parameters
from mocapbench.baselines.gp.solvers.block import Block
from mocapbench.baselines.gp.solvers.entries import pick_entries, place_entries
from mocapbench.baselines.gp.solvers.solver import Mapper, refuse_singular
from mocapbench.basics.arrays import Array

__all__ = ["collect_gradient", "invert_parts", "pull_back_parts", "stack_slopes"]


def invert_parts(
    kernel: StationaryKernel, block: Block, parameters: Parameters, mapper: Mapper
) -> tuple[Array, Array, float]:
    """Return U_τ ⊗ k_τ (n_components, m²), F_d = E_d⁻¹ (D, m, m) and Σ_d log|E_d|.

    F_d is 0 where the output is hidden.

    Raises
    ------
    SingularCovarianceError
        If some E_d is not numerically positive definite.
    """
    entries = block.entries
    kernels, kappa = _kernels(kernel.value, block, parameters), _kappa(block, parameters)
    noise = parameters.noise[:, None] * _noise_scale(block)
    precision = np.empty(entries.shape)

    def invert_chunk(outputs: slice) -> float:
        # Σ_τ κ_τd U_τ ⊗ k_τ of a run of outputs at once.
        matrices = (kappa[:, outputs].T @ kernels).reshape(-1, *entries.shape[1:])
        total = 0.0
        for d, matrix in zip(range(*outputs.indices(len(noise))), matrices, strict=True):
            # E_d at the visible rows, its inverse F_d, and F_d over all rows.
            positions = entries.positions[d]
            covariance = pick_entries(matrix, positions)
            covariance.reshape(-1)[:: len(covariance) + 1] += noise[d, positions]
            total += invert(covariance)
            place_entries(covariance, positions, precision[d])
        return total

    with refuse_singular(parameters):
        log_determinant = sum(mapper(invert_chunk, entries.chunks))
    return kernels, precision, log_determinant


def pull_back_parts(
    kernels: Array, slopes: Array, block: Block, adjoint: Callable[[slice], Array], mapper: Mapper
) -> tuple[Array, Array, Array]:
    """Return ⟨Ē_d, U_τ ⊗ k_τ⟩, ⟨Ē_d, U_τ ⊗ ∂k_τ⟩ and Σ_m s_dm Ē_d,mm of a function of E.

    Parameters
    ----------
    kernels, slopes : ndarray of shape (n_components, m²)
        U_τ ⊗ k_τ and U_τ ⊗ ∂k_τ.
    block : Block
        The problem.
    adjoint : callable
        From a run of outputs, a slice, to their Ē, (·, m, m).
    mapper : callable
        Calls a function for every run of outputs.

    Returns
    -------
    by_kappa, by_scale : ndarray of shape (n_components, D)
    by_noise : ndarray of shape (D,)
    """
    scale, functions = _noise_scale(block), np.vstack([kernels, slopes])

    def contract(outputs: slice) -> tuple[Array, Array]:
        # ⟨Ē_d, U_τ ⊗ k_τ⟩ and ⟨Ē_d, U_τ ⊗ ∂k_τ⟩, and the diagonal of Ē_d times s.
        adjoints = adjoint(outputs)
        by_noise = np.einsum("dmm,dm->d", adjoints, scale[outputs])
        return functions @ adjoints.reshape(len(adjoints), -1).T, by_noise

    products, by_noise = zip(*mapper(contract, block.entries.chunks), strict=True)
    by_kappa, by_scale = np.split(np.hstack(products), 2)
    return by_kappa, by_scale, np.hstack(by_noise)


def collect_gradient(
    block: Block, parameters: Parameters, by_kappa: Array, by_scale: Array, by_noise: Array
) -> Parameters:
    """Return the gradient, given the results of `pull_back_parts`."""
    layers, start = {}, 0
    for name, layer in parameters.layers.items():
        layers[name] = layer.zeros()
        if name in block.units:
            components = slice(start, start + len(layer.lengthscales))
            start = components.stop
            # ∂ log ℓ_τ = Σ_d κ_τd ⟨Ē_d, U_τ ⊗ ∂k_τ⟩ and ∂√κ = 2 √κ ⟨Ē_d, U_τ ⊗ k_τ⟩.
            layers[name] = LayerParameters(
                (layer.kappa * by_scale[components]).sum(axis=1),
                np.zeros_like(layer.weights),
                2.0 * layer.kappa_roots * by_kappa[components],
            )
    return Parameters(layers, parameters.noise * by_noise)


def stack_slopes(kernel: StationaryKernel, block: Block, parameters: Parameters) -> Array:
    """Return U_τ ⊗ ∂k_τ, the derivatives in log ℓ, (n_components, m²)."""
    return _kernels(kernel.gradient, block, parameters)


def _noise_scale(block: Block) -> Array:
    """Return the factors of the noise at the rows, (D, m)."""
    return np.asarray(block.noise_scale[block.entries.unit, :, block.entries.time].T)


def _kappa(block: Block, parameters: Parameters) -> Array:
    """Return κ of the components of all layers of the block, (n_components, D)."""
    layers = [layer for name, layer in parameters.layers.items() if name in block.units]
    return np.concatenate([layer.kappa for layer in layers])


def _kernels(
    function: Callable[[Array, Array], Array], block: Block, parameters: Parameters
) -> Array:
    """Return U_τ ⊗ k_τ, or with ∂k_τ, between all rows: (n_components, m²)."""
    unit, time = block.entries.unit, block.entries.time
    kernels = []
    for name, layer in parameters.layers.items():
        if name in block.units:
            by_lag = function(block.lags, layer.lengthscales[:, None, None])
            gram = block.grams[name][unit][:, unit]
            kernels.append(gram * by_lag[:, time][:, :, time])
    return np.concatenate(kernels).reshape(-1, len(unit) ** 2)
