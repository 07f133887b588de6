r"""Draws from a linear model of coregionalisation, without forming its covariance.

A component is :math:`B_q \otimes k_q` with :math:`B_q = W W^\top + \operatorname{diag}(\kappa)`
and :math:`k_q = \Lambda\Lambda^\top`. A draw is white noise multiplied by Λ in time and by
:math:`[W, \sqrt{\operatorname{diag}\kappa}]` in outputs (docs/inference.md, section 9).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import LayerParameters
from mocapbench.baselines.gp.prior.pivoted import PivotedRoot

__all__ = ["draw_layer"]

Array = NDArray[np.float64]


def draw_layer(
    kernel: StationaryKernel,
    layer: LayerParameters,
    times: Array,
    n_samples: int,
    rng: np.random.Generator,
) -> Array:
    """Return (n_samples, M, D) draws of Σ_q B_q ⊗ k_q at ``times`` (M,)."""
    weights, roots = layer.coregionalisation.weights, layer.coregionalisation.kappa_roots
    total = np.zeros((n_samples, len(times), roots.shape[1]))
    for lengthscale, columns, kappa_roots in zip(layer.lengthscales, weights, roots, strict=True):
        root = PivotedRoot.of(kernel, float(lengthscale), times).values
        mixing = np.hstack([columns, np.diag(kappa_roots)])
        white = rng.standard_normal((n_samples, root.shape[1], mixing.shape[1]))
        total += root @ white @ mixing.T
    return total
