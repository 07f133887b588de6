r"""Draws from a linear model of coregionalisation, without forming its covariance.

A component is :math:`B_q \otimes k_q` with :math:`B_q = W W^\top + \operatorname{diag}(\kappa)`
and :math:`k_q = L L^\top`. A draw is white noise multiplied by L in time and by
:math:`[W, \sqrt{\operatorname{diag}\kappa}]` in outputs (docs/mathematics/prediction.md, section
9).
"""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import LayerParameters
from mocapbench.basics.arrays import Array

__all__ = ["draw_layer"]


JITTER = 1e-10
"""Variance added to a kernel matrix, relative to the kernel's. Rounding leaves the smallest
eigenvalues of a smooth kernel below zero by some 1e-14."""


def draw_layer(
    kernel: StationaryKernel,
    layer: LayerParameters,
    times: Array,
    n_samples: int,
    rng: np.random.Generator,
) -> Array:
    """Return (n_samples, M, D) draws of Σ_q B_q ⊗ k_q at ``times`` (M,).

    Equal times get equal values. Rounding, which differs among processors, changes draws by little:
    the Cholesky factor is continuous in the matrix, and the roots of κ count without their sign.
    """
    grid, places = np.unique(times, return_inverse=True)
    total = np.zeros((n_samples, len(grid), layer.kappa_roots.shape[1]))
    components = zip(layer.lengthscales, layer.weights, layer.kappa_roots, strict=True)
    for lengthscale, columns, kappa_roots in components:
        gram = kernel.value(np.subtract.outer(grid, grid), float(lengthscale))
        root = np.linalg.cholesky(gram + JITTER * np.eye(len(grid)))
        mixing = np.hstack([columns, np.diag(np.abs(kappa_roots))])
        white = rng.standard_normal((n_samples, len(grid), mixing.shape[1]))
        total += root @ white @ mixing.T
    return total[:, places]
