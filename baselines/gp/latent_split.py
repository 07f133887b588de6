r"""Inference by splitting every output into what it shares and what is its own.

A coregionalisation matrix is :math:`W W^\top + \operatorname{diag}(\kappa)`: given the latent
functions behind :math:`W`, the *outputs are independent*. The covariance of a block is therefore

.. math:: K = A K_v A^\top + \operatorname{blockdiag}_d E_d,

with one latent function for every component, column of :math:`W` and independent draw of the
layer, :math:`K_v = \Lambda\Lambda^\top` their block-diagonal prior, :math:`A_d` the rows
:math:`w_{id}\, c_i \otimes I`, and :math:`E_d` the covariance of output d's own part and noise.
With :math:`F_d = E_d^{-1}`, zero at hidden entries so that masks vanish from the formulae,

.. math:: G = A^\top F A, \quad S = I + \Lambda^\top G \Lambda, \quad
          \log|K| = \sum_d \log|E_d| + \log|S|, \quad u = S^{-1}\Lambda^\top A^\top F z,

and with the residual :math:`r = z - A \Lambda u`, :math:`\alpha = K^{-1}z = F r`, and the quadratic
form is :math:`r^\top F r + u^\top u`: a sum of squares, where the textbook difference
:math:`z^\top F z - b^\top \Lambda u` cancels.

The cost is that of D matrices of side P N and one of side (number of latents) × N.
"""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.block import Block, Target
from mocapbench.baselines.gp.parameters import Parameters
from mocapbench.baselines.gp.solver import Posterior, Solver
from mocapbench.baselines.gp.split import Split
from mocapbench.baselines.gp.split_gradient import split_gradient

__all__ = ["LatentSplit"]

Array = NDArray[np.float64]

OVERHEAD = 4e8
"""What a block costs besides its factorisations, as operations (about ten milliseconds)."""


class LatentSplit(Solver):
    """O(Σ_d n_d³ + (latents × N)³): for many outputs, few latents and few patterns."""

    name: ClassVar[str] = "latent-split"

    def evaluate(self, block: Block, parameters: Parameters) -> tuple[float, Parameters]:
        """Return the log-density of the block's data and its gradient."""
        split = Split.of(self.kernel, block, parameters)
        return split.log_density, split_gradient(split)

    def condition(self, block: Block, parameters: Parameters) -> Posterior:
        """Return the posterior given the block's data."""
        return _SplitPosterior(Split.of(self.kernel, block, parameters))

    def work(self, block: Block, parameters: Parameters) -> float:
        """Return 5 Σ_d n_d³ + 2 (latents × N)³ and an overhead."""
        own = block.observed.sum(axis=(0, 2)).astype(np.float64)
        n_latents = sum(
            factor.shape[1] * parameters.layers[name].coregionalisation.weights[:, 0].size
            for name, factor in block.units.items()
        )
        shared = float(n_latents * len(block.times))
        return 5.0 * float((own**3).sum()) + 2.0 * shared**3 + OVERHEAD


class _SplitPosterior(Posterior):
    r"""The posterior of white coordinates and own parts.

    The target in output d is :math:`T_d u + e_d`, with :math:`T_d` the regression on the white
    coordinates and :math:`e_d` its own part, whose covariance with the visible entries is
    :math:`c_d`. With :math:`J_d = T_d - c_d F_d A_d \Lambda` the mean is
    :math:`T_d u + c_d \alpha_d` and the variance
    :math:`\operatorname{diag}(J_d S^{-1} J_d^\top - c_d F_d c_d^\top)` plus the prior variance
    that :math:`u` does not explain.
    """

    def __init__(self, split: Split) -> None:
        self.split = split

    def predict(self, target: Target, times: Array) -> tuple[Array, Array]:
        split, latents = self.split, self.split.latents
        shared, coefficients = latents.at(times), latents.spread(latents.coefficients(target))
        variance = np.repeat(self._prior(target)[:, None], len(times), axis=1)
        mean = np.empty((len(split.block.data), *variance.shape))
        for d, curves in enumerate(self._own_cross(target, times)):
            cross = curves[:, split.block.entries.positions[d]]
            regression = shared * coefficients[:, d]
            weighted = cross @ split.precision.matrices[d]
            variance[d] -= np.square(regression).sum(axis=1)
            mean[:, d] = (regression @ split.white + cross @ split.alpha[d]).T
            regression -= weighted @ self._white_loadings(d)
            variance[d] += np.einsum("mi,mi->m", regression @ split.inverse, regression)
            variance[d] -= np.einsum("mi,mi->m", weighted, cross)
        return mean, split.block.share_of_variance * np.maximum(variance, 0.0)

    def _prior(self, target: Target) -> Array:
        layers = self.split.parameters.layers
        return np.asarray(
            sum(
                target.prior_scale(name) * layers[name].coregionalisation.variances
                for name in self.split.block.units
            )
        )

    def _white_loadings(self, d: int) -> Array:
        """Return A_d Λ at the output's visible entries, (n_d, K)."""
        latents = self.split.latents
        unit, time = np.divmod(self.split.block.entries.positions[d], latents.n_times)
        loadings = latents.spread(latents.loadings[:, d].T)
        return np.asarray(loadings[:, unit].T * latents.root[time])

    def _own_cross(self, target: Target, times: Array) -> Array:
        """Return c, (D, M, P N), the covariance of the own parts with the grid of entries."""
        split = self.split
        n_units, n_outputs, n_times = split.block.observed.shape
        cross = np.zeros((n_outputs, len(times), n_units, n_times))
        lags = np.subtract.outer(times, split.block.times)
        for name, factor in split.block.units.items():
            layer = split.parameters.layers[name]
            kernels = split.kernel.value(lags, layer.lengthscales[:, None, None])
            curves = np.tensordot(layer.coregionalisation.kappa, kernels, axes=(0, 0))
            cross += (factor @ target.weights[name])[:, None] * curves[:, :, None]
        return cross.reshape(n_outputs, len(times), n_units * n_times)
