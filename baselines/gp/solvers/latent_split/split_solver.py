r"""Inference by splitting every output into a shared and an independent part.

A coregionalisation matrix is :math:`W W^\top + \operatorname{diag}(\kappa)`. Given the latent
functions that :math:`W` mixes, the *outputs are independent* (docs/mathematics/solvers.md, section
5). The covariance of a block is therefore

.. math:: K = A K_v A^\top + \operatorname{blockdiag}_d E_d,

with one latent function for every component, column of :math:`W` and independent draw of the
layer, :math:`K_v = \Lambda\Lambda^\top` their block-diagonal prior, :math:`A_d` the rows
:math:`w_{id}\, c_i \otimes I`, and :math:`E_d` the covariance of output d's independent part and
noise. With :math:`F_d = E_d^{-1}`, zero at hidden entries so that the formulae need no masks,

.. math:: G = A^\top F A, \quad S = I + \Lambda^\top G \Lambda, \quad
          \log|K| = \sum_d \log|E_d| + \log|S|, \quad u = S^{-1}\Lambda^\top A^\top F z,

and with the residual :math:`r = z - A \Lambda u`, :math:`\alpha = K^{-1}z = F r`. The quadratic
form is the sum of squares :math:`r^\top F r + u^\top u`; the textbook difference
:math:`z^\top F z - b^\top \Lambda u`, with :math:`b = A^\top F z`, loses digits by cancellation
when the noise is small.

The cost is that of D matrices of side P N and one of side (number of latents) × N.
"""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.baselines.gp.solvers.latent_split.factorisation import Factorisation
from mocapbench.baselines.gp.solvers.latent_split.split_gradient import split_gradient
from mocapbench.baselines.gp.solvers.solver import BlockPosterior, Solver
from mocapbench.basics.arrays import Array

__all__ = ["LatentSplit"]


OVERHEAD = 6e7
"""Cost of a block apart from its factorisations, in operations (about four milliseconds)."""
OUTPUT_OVERHEAD = 2e6
"""The same for each output, in operations (about a tenth of a millisecond)."""


class LatentSplit(Solver):
    """Cost O(Σ_d n_d³ + (latents × N)³): the choice for many outputs and few latent functions."""

    name: ClassVar[str] = "latent-split"

    def evaluate(self, block: Block, parameters: Parameters) -> tuple[float, Parameters]:
        """Return the log-density of the block's data and its gradient."""
        split = Factorisation.of(self.kernel, block, parameters, self.mapper)
        return split.log_density, split_gradient(split, self.mapper)

    def condition(self, block: Block, parameters: Parameters) -> BlockPosterior:
        """Return the posterior given the block's data."""
        return _SplitPosterior(Factorisation.of(self.kernel, block, parameters, self.mapper))

    def work(self, block: Block, parameters: Parameters) -> float:
        """Return 3 Σ_d n_d³ + 1.5 K³ and overheads.

        K is the number of visible frames, summed over latent functions.
        """
        visible = block.observed.sum(axis=(0, 2)).astype(np.float64)
        shared = 0.0
        for name, factor in block.units.items():
            seen = (factor != 0.0).T @ block.observed.any(axis=1) > 0
            n_columns = parameters.layers[name].weights[:, 0].size
            shared += float(n_columns * seen.sum())
        overhead = OVERHEAD + OUTPUT_OVERHEAD * len(visible)
        return 3.0 * float((visible**3).sum()) + 1.5 * shared**3 + overhead


class _SplitPosterior(BlockPosterior):
    r"""The posterior of white coordinates and independent parts.

    The symbols are those of docs/mathematics/prediction.md, section 8.

    The target in output d is :math:`T_d u + e_d`, with :math:`T_d` the regression on the white
    coordinates and :math:`e_d` its independent part, whose covariance with the visible entries is
    :math:`c_d`. With :math:`J_d = T_d - c_d F_d A_d \Lambda` the mean is
    :math:`T_d u + c_d \alpha_d` and the variance
    :math:`\operatorname{diag}(J_d S^{-1} J_d^\top - c_d F_d c_d^\top)` plus the prior variance
    that :math:`u` does not explain.
    """

    def __init__(self, split: Factorisation) -> None:
        self.split = split

    def predict(self, target: Target, times: Array) -> tuple[Array, Array]:
        split, latents = self.split, self.split.latents
        # Λ at the times, and A Λ by columns of weights.
        shared, coefficients = latents.at(times), latents.coefficients(target)
        loadings = self._white_loadings()
        variance = np.repeat(self._prior(target)[:, None], len(times), axis=1)
        mean = np.empty((len(split.block.data), *variance.shape))
        for d, cross in enumerate(self._independent_cross(target, times)):
            # T_d, c_d F_d, and the mean T_d u + c_d α_d.
            regression = shared * coefficients[:, d]
            weighted = cross @ split.precision[d]
            variance[d] -= np.square(regression).sum(axis=1)
            mean[:, d] = (regression @ split.white + cross @ split.alpha[d]).T
            # J_d = T_d − c_d F_d A_d Λ, and the variance.
            for weight, of_column in zip(latents.weights[:, d], loadings, strict=True):
                regression -= weight * (weighted @ of_column)
            variance[d] += np.einsum("mi,mi->m", regression @ split.inverse, regression)
            variance[d] -= np.einsum("mi,mi->m", weighted, cross)
        return mean, split.block.variance_scale * np.maximum(variance, 0.0)

    def _prior(self, target: Target) -> Array:
        layers = self.split.parameters.layers
        return np.asarray(
            sum(
                target.prior_scale(name) * layers[name].variances for name in self.split.block.units
            )
        )

    def _white_loadings(self) -> Array:
        """Return Σ_i c_i ⊗ Λ_i of each column of weights, (n, m, K); it multiplies u."""
        latents, entries = self.split.latents, self.split.block.entries
        loadings = np.zeros((len(latents.columns), len(entries.unit), latents.n_white))
        for latent in latents.functions:
            loadings[latent.column, :, latent.white] = entries.unfold(latent.units, latent.values)
        return loadings

    def _independent_cross(self, target: Target, times: Array) -> Array:
        """Return c, (D, M, m), the covariance of the target's independent parts with the rows."""
        split, entries = self.split, self.split.block.entries
        cross = np.zeros((split.precision.shape[0], len(times), len(entries.unit)))
        lags = np.subtract.outer(times, split.block.times[entries.time])
        for name, factor in split.block.units.items():
            layer = split.parameters.layers[name]
            kernels = split.kernel.value(lags, layer.lengthscales[:, None, None])
            curves = np.tensordot(layer.kappa.T, kernels, axes=1)
            cross += (factor @ target.weights[name])[entries.unit] * curves
        return cross
