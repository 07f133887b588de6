r"""The independent part of each output.

:math:`E_d = \sum_\tau \kappa_{\tau d}\, U_\tau \otimes k_\tau + \nu_d`, where :math:`\tau` runs
over the components of all layers, :math:`U_\tau` is the layer's Gram matrix over units and
:math:`\nu_d` the noise (docs/mathematics/solvers.md, section 5). There is one matrix for each
output, over the m rows of the block.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.common.cholesky import invert
from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import LayerParameters, Parameters
from mocapbench.baselines.gp.solvers.block import Block
from mocapbench.baselines.gp.solvers.entries import pick_entries, place_entries
from mocapbench.baselines.gp.solvers.solver import refuse_singular
from mocapbench.baselines.gp.solvers.threads import Mapper
from mocapbench.basics.arrays import Array

__all__ = ["IndependentParts"]


@dataclass(frozen=True, eq=False)
class IndependentParts:
    """The covariances of the outputs' independent parts, inverted.

    Parameters
    ----------
    kernel, block, parameters : StationaryKernel, Block, Parameters
        The problem.
    kernels : ndarray of shape (n_components, m²)
        U_τ ⊗ k_τ, for the components of all layers of the block.
    precision : ndarray of shape (D, m, m)
        F_d = E_d⁻¹, 0 where hidden.
    log_determinant : float
        Σ_d log|E_d|.
    """

    kernel: StationaryKernel
    block: Block
    parameters: Parameters
    kernels: Array
    precision: Array
    log_determinant: float

    @classmethod
    def of(
        cls, kernel: StationaryKernel, block: Block, parameters: Parameters, mapper: Mapper
    ) -> IndependentParts:
        """Invert E_d for every output.

        Raises
        ------
        SingularCovarianceError
            If one is not numerically positive definite.
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
        return cls(kernel, block, parameters, kernels, precision, log_determinant)

    def gradient(self, adjoint: Callable[[slice], Array], mapper: Mapper) -> Parameters:
        """Return the gradient of a function of E whose adjoint is Ē.

        Parameters
        ----------
        adjoint : callable
            From a run of outputs, a slice, to their Ē, (·, m, m).
        mapper : callable
            Calls a function for every run of outputs.
        """
        scale = _noise_scale(self.block)
        functions = np.vstack(
            [self.kernels, _kernels(self.kernel.gradient, self.block, self.parameters)]
        )

        def contract(outputs: slice) -> tuple[Array, Array]:
            # ⟨Ē_d, U_τ ⊗ k_τ⟩ and ⟨Ē_d, U_τ ⊗ ∂k_τ⟩, and the diagonal of Ē_d times s.
            adjoints = adjoint(outputs)
            by_noise = np.einsum("dmm,dm->d", adjoints, scale[outputs])
            return functions @ adjoints.reshape(len(adjoints), -1).T, by_noise

        products, by_noise = zip(*mapper(contract, self.block.entries.chunks), strict=True)
        by_kappa, by_scale = np.split(np.hstack(products), 2)
        return self._collect(by_kappa, by_scale, self.parameters.noise * np.hstack(by_noise))

    def _collect(self, by_kappa: Array, by_scale: Array, by_noise: Array) -> Parameters:
        """Return the gradient from ⟨Ē_d, U_τ ⊗ k_τ⟩ and ⟨Ē_d, U_τ ⊗ ∂k_τ⟩, (n_components, D)."""
        layers, start = {}, 0
        for name, layer in self.parameters.layers.items():
            layers[name] = layer.zeros()
            if name in self.block.units:
                components = slice(start, start + len(layer.lengthscales))
                start = components.stop
                # ∂ log ℓ_τ = Σ_d κ_τd ⟨Ē_d, U_τ ⊗ ∂k_τ⟩ and ∂√κ = 2 √κ ⟨Ē_d, U_τ ⊗ k_τ⟩.
                layers[name] = LayerParameters(
                    (layer.kappa * by_scale[components]).sum(axis=1),
                    np.zeros_like(layer.weights),
                    2.0 * layer.kappa_roots * by_kappa[components],
                )
        return Parameters(layers, by_noise)


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
