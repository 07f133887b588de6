r"""The gradient of the latent split.

With M = Λ S⁻¹ Λᵀ the posterior covariance of the latent functions and
X_d = Σ_ij w_id w_jd c_i c_jᵀ ⊗ M_ij its image in output d,

.. math:: (K^{-1})_{dd} = F_d - F_d X_d F_d, \qquad
          \bar E_d = \tfrac12 \big(\alpha_d \alpha_d^\top - \rho (K^{-1})_{dd}\big)

is all that κ, β and a lengthscale's effect on the outputs' own parts need. The shared parts give

.. math::
   \partial w_{id} &= \alpha_d^\top (c_i \otimes \Lambda_i u_i)
       - \rho \sum_j w_{jd} \langle F_d, c_i c_j^\top \otimes M_{ij} \rangle, \\
   \partial \log \ell &\ni \sum_i \tfrac12 \big\langle \partial k,\;
       a_i a_i^\top - \rho\, (G - G M G)_{ii} \big\rangle, \qquad a = A^\top \alpha,

the sum being over the latent functions of the component. With S = L Lᵀ the reduction
:math:`G M G` is :math:`H^\top H`, :math:`H = L^{-1} \Lambda^\top G`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.cholesky import solve_lower
from mocapbench.baselines.gp.own import own_gradient
from mocapbench.baselines.gp.parameters import Layer, Parameters
from mocapbench.baselines.gp.split import Split
from mocapbench.baselines.gp.unit_pairs import unit_pairs

__all__ = ["split_gradient"]

Array = NDArray[np.float64]


def split_gradient(split: Split) -> Parameters:
    """Return the gradient of the log-density of the split's block."""
    covariance = _latent_covariance(split)
    own = _own_adjoint(split, covariance)
    gradient = own_gradient(split.kernel, split.block, split.parameters, own)
    alpha = split.block.entries.place(split.alpha, split.white.shape[1])
    shared = _latent_adjoint(split, alpha)
    weights = _weight_gradient(split, alpha, covariance)
    for name in split.block.units:
        _add_shared(split, name, shared, weights, gradient.layers[name])
    return gradient


def _latent_covariance(split: Split) -> Array:
    """Return (n, n, N, N), the blocks of M, the posterior covariance of the latent functions."""
    latents, covariance = split.latents, np.empty_like(split.gram)
    for i, (own, root) in enumerate(zip(latents.slices, latents.values, strict=True)):
        rows = root @ split.inverse[own]
        for j, (other, other_root) in enumerate(zip(latents.slices, latents.values, strict=True)):
            covariance[i, j] = rows[:, other] @ other_root.T
    return covariance


def _own_adjoint(split: Split, covariance: Array) -> Array:
    """Return Ē, a grid (P, P, D, N, N)."""
    images, adjoint = _images(split, covariance), split.block.entries.zeros()
    outputs = zip(split.block.entries.pairs, split.precision.matrices, split.alpha, strict=True)
    for pairs, precision, alpha in outputs:
        inverse = precision - precision @ images.take(pairs) @ precision
        adjoint.reshape(-1)[pairs] = 0.5 * (alpha @ alpha.T - split.block.multiplicity * inverse)
    return adjoint


def _images(split: Split, covariance: Array) -> Array:
    """Return X, a grid (P, P, D, N, N)."""
    images = np.empty_like(split.precision.grid)
    for pair in unit_pairs(split.latents):
        blocks = covariance[pair.blocks]
        images[pair.units] = np.tensordot(pair.products, blocks, axes=((0, 1), (0, 1)))
    return images


def _latent_adjoint(split: Split, alpha: Array) -> Array:
    """Return ½(a_i a_iᵀ − ρ (G − G M G)_ii), (n, N, N); ``alpha`` (P, D, N, h) is α."""
    n, n_times, n_white = split.rooted_gram.shape
    projected = split.latents.project(alpha)
    outer = projected @ projected.transpose(0, 2, 1)
    rooted = split.rooted_gram.reshape(n * n_times, n_white)
    half = solve_lower(split.factor, rooted.T).T.reshape(n, n_times, n_white)
    reduced = split.gram[np.arange(n), np.arange(n)] - half @ half.transpose(0, 2, 1)
    return np.asarray(0.5 * (outer - split.block.multiplicity * reduced))


def _weight_gradient(split: Split, alpha: Array, covariance: Array) -> Array:
    """Return ∂w, (n, D); ``alpha`` (P, D, N, h) is α."""
    latents = split.latents
    by_unit = np.tensordot(latents.units, alpha, axes=1)
    gradient = np.einsum("idth,ith->id", by_unit, latents.curves(split.white))
    for pair in unit_pairs(latents):
        overlap = np.tensordot(
            split.precision.grid[pair.units], covariance[pair.blocks], axes=((1, 2), (2, 3))
        )
        (rows, _), (_, loadings) = pair.members, pair.loadings
        spread = np.einsum("dij,jd->id", overlap, loadings)
        seen = latents.units[rows, pair.units[0], None]
        gradient[rows] -= split.block.multiplicity * seen * spread
    return np.asarray(gradient)


def _add_shared(split: Split, name: str, shared: Array, weights: Array, gradient: Layer) -> None:
    """Add what the latent functions contribute to the gradient in a layer."""
    layer = split.parameters.layers[name]
    slopes = split.kernel.gradient(split.block.lags, layer.lengthscales[:, None, None])
    for label, adjoint, by_weight in zip(split.latents.labels, shared, weights, strict=True):
        if label.layer == name:
            gradient.log_lengthscales[label.component] += np.vdot(slopes[label.component], adjoint)
            gradient.coregionalisation.weights[label.component, :, label.column] += by_weight
