r"""The gradient of the latent split (docs/mathematics/solvers.md, section 5, "Gradient").

With :math:`M = \Lambda S^{-1} \Lambda^\top` the posterior covariance of the latent functions, let
:math:`Z_{ab} = \sum_{i \in a, j \in b} c_i c_j^\top \otimes M_{ij}` collect it by columns of
weights, and :math:`X_d = \sum_{ab} w_{ad} w_{bd} Z_{ab}` be its image in output d. Then

.. math:: (K^{-1})_{dd} = F_d - F_d X_d F_d, \qquad
          \bar E_d = \tfrac12 \big(\alpha_d \alpha_d^\top - \rho (K^{-1})_{dd}\big)

give the gradients in κ and β and the effect of a lengthscale on the independent parts. The shared
parts give, with
:math:`\partial(\Lambda_i \Lambda_i^\top) = V_i \Lambda_i^\top + \Lambda_i V_i^\top -
\Lambda_i T_i \Lambda_i^\top`,

.. math::
   \partial w_{ad} &= \alpha_d^\top \sum_{i \in a} (c_i \otimes \Lambda_i u_i)
       - \rho \sum_b w_{bd} \langle F_d, Z_{ab} \rangle, \\
   \partial \log \ell &\ni \sum_i \big\langle V_i,\;
       (A^\top \alpha)_i u_i^\top - \rho\, (G \Lambda S^{-1})_{ii} \big\rangle
       - \tfrac12 \big\langle T_i,\; u_i u_i^\top - \rho\, (I - S^{-1})_{ii} \big\rangle,

the sum being over the latent functions of the component. The last line uses
:math:`\Lambda^\top A^\top \alpha = u`, :math:`A^\top K^{-1} A \Lambda = G \Lambda S^{-1}` and
:math:`\Lambda^\top A^\top K^{-1} A \Lambda = I - S^{-1}`.
"""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.entries import pick_entries, place_entries
from mocapbench.baselines.gp.solvers.latent_split.factorisation import Factorisation, project
from mocapbench.baselines.gp.solvers.latent_split.independent_parts import (
    collect_gradient,
    pull_back_parts,
    stack_slopes,
)
from mocapbench.baselines.gp.solvers.solver import Mapper
from mocapbench.basics.arrays import Array

__all__ = ["split_gradient"]


def split_gradient(split: Factorisation, mapper: Mapper) -> Parameters:
    """Return the gradient of the log-density of the factorised block."""
    # Z_ab of each pair of columns, and with them ∂w.
    covariance = _by_pairs(split)
    weights = _weight_gradient(split, covariance)
    # Ē_d of each output, and with it ∂κ, ∂β and the independent parts' term of ∂ log ℓ.
    gradient = collect_gradient(
        split.block,
        split.parameters,
        *pull_back_parts(
            split.kernels,
            stack_slopes(split.kernel, split.block, split.parameters),
            split.block,
            lambda outputs: _independent_adjoint(split, covariance, outputs),
            mapper,
        ),
    )
    for (name, q, number), by_weight in zip(split.latents.columns, weights, strict=True):
        gradient.layers[name].weights[q, :, number] += by_weight
    _add_scale_gradient(split, gradient)
    return gradient


def _by_pairs(split: Factorisation) -> Array:
    """Return Z_aa and Z_ab + Z_abᵀ for the pairs a ≤ b of columns, (n_pairs, m²)."""
    latents, entries = split.latents, split.block.entries
    n_rows = len(entries.unit)
    # The rows of M = Λ S⁻¹ Λᵀ, but for the last factor.
    rows = [latent.values @ split.inverse[latent.white] for latent in latents.functions]
    total = np.zeros((len(latents.pairs), n_rows, n_rows))
    for (a, b), matrix in zip(latents.pairs, total, strict=True):
        for i in latents.by_column[a]:
            for j in latents.by_column[b]:
                # c_i c_jᵀ ⊗ M_ij
                other = latents.functions[j]
                block = rows[i][:, other.white] @ other.values.T
                entries.add_unfolded(latents.functions[i].units, other.units, block, matrix)
        if a != b:
            matrix[...] = matrix + matrix.T
    return total.reshape(len(total), n_rows**2)


def _weight_gradient(split: Factorisation, covariance: Array) -> Array:
    """Return ∂w, (n, D)."""
    weights = split.latents.weights
    # α_dᵀ Σ_i c_i ⊗ Λ_i u_i, then ⟨F_d, Z_ab + Z_ba⟩ of each pair and output.
    gradient = np.tensordot(split.shared, split.alpha, axes=((1, 2), (1, 2)))
    overlaps = covariance @ split.precision.reshape(weights.shape[1], -1).T
    for (a, b), overlap in zip(split.latents.pairs, overlaps, strict=True):
        # Each pair stands for Z_ab and Z_ba, whose inner products with F_d are equal.
        gradient[a] -= 0.5 * split.block.multiplicity * weights[b] * overlap
        gradient[b] -= 0.5 * split.block.multiplicity * weights[a] * overlap
    return np.asarray(gradient)


def _independent_adjoint(split: Factorisation, covariance: Array, outputs: slice) -> Array:
    """Return Ē of a run of outputs, (·, m, m)."""
    entries, rho = split.block.entries, split.block.multiplicity
    # X_d = Σ_ab w_ad w_bd Z_ab
    images = split.latents.products[:, outputs].T @ covariance
    adjoint = images.reshape(-1, *entries.shape[1:])
    for d, matrix in zip(range(*outputs.indices(entries.shape[0])), adjoint, strict=True):
        positions = entries.positions[d]
        precision = pick_entries(split.precision[d], positions)
        alpha = split.alpha[d, positions]
        # ½ (Σ_r α_d α_dᵀ − ρ (F_d − F_d X_d F_d))
        visible = precision @ pick_entries(matrix, positions) @ precision
        visible -= precision
        visible *= rho
        visible += alpha @ alpha.T
        visible *= 0.5
        place_entries(visible, positions, matrix)
    return adjoint


def _add_scale_gradient(split: Factorisation, gradient: Parameters) -> None:
    """Add the derivatives of the latent functions' covariances in the lengthscales."""
    rho = split.block.multiplicity
    # Aᵀ α of each latent function.
    projected = project(split.latents, split.block.entries, split.alpha)
    for latent, row, curve in zip(
        split.latents.functions, split.rooted_gram, projected, strict=True
    ):
        name, q, _ = split.latents.columns[latent.column]
        # V_i and T_i, the factors of ∂(Λ_i Λ_iᵀ).
        slope, inner = latent.root.slope(split.block.times[latent.seen])
        white, inverse = split.white[latent.white], split.inverse[latent.white, latent.white]
        # (Aᵀ α)_i u_iᵀ − ρ (G Λ S⁻¹)_ii and u_i u_iᵀ − ρ (I − S⁻¹)_ii
        outer = curve @ white.T - rho * row @ split.inverse[:, latent.white]
        square = white @ white.T - rho * (np.eye(len(inverse)) - inverse)
        gradient.layers[name].log_lengthscales[q] += np.vdot(slope, outer[latent.seen])
        gradient.layers[name].log_lengthscales[q] -= 0.5 * np.vdot(inner, square)
