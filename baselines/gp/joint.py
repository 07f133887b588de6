r"""The joint posterior of a term of a curve at several times: its covariance, and draws from it.

Conditioning is linear in the data, so posterior means of suitable data vectors are all that is
needed of a solver (docs/mathematics/prediction.md, sections 8
and 9). A target of a block, with values
:math:`f_*` at the requested times and cross covariance :math:`K_*` with the visible entries, has

* the posterior covariance :math:`\tfrac{\rho}{h}(K_{**} - K_* K^{-1} K_*^\top)`, where
  :math:`K_* K^{-1} K_*^\top` is the posterior mean given the columns of :math:`K_*^\top` as data;
* the posterior draw :math:`\sqrt{\rho/h}\, \tilde f_* + K_* K^{-1}(z - \sqrt{\rho/h}\, \tilde z)`,
  where :math:`(\tilde z, \tilde f_*)` is a draw of the data and the target from the prior.

The second is Matheron's rule (Wilson et al. 2021, *Pathwise Conditioning of Gaussian Processes*,
JMLR 22, Theorem 1). It needs draws of the layers at the times, but no joint covariance.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.prior.sampling import draw_layer
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.baselines.gp.solvers.solver import Solver
from mocapbench.basics.arrays import Array

__all__ = ["TermPosterior"]


@dataclass(frozen=True, eq=False)
class TermPosterior:
    """The posterior of one term of a curve at all times together, in standard units.

    Either method conditions the block once: `covariance` on D M data vectors, `draw` on one for
    each draw.

    Parameters
    ----------
    block : Block
        The problem.
    solver : Solver
        The solver of the block.
    parameters : Parameters
        The parameters of the model.
    target : Target
        The term.
    times : ndarray of shape (M,)
        In any order.
    """

    block: Block
    solver: Solver
    parameters: Parameters
    target: Target
    times: Array

    def covariance(self) -> Array:
        """Return the posterior covariance (D M, D M), outputs slowest."""
        prior = self._prior()
        # (ρ / h) (K_** − K_* K⁻¹ K_*ᵀ)
        explained = self._mean_given(self._cross()).reshape(prior.shape)
        return np.asarray(self.block.variance_scale * (prior - explained))

    def draw(self, column: int, n_samples: int, rng: np.random.Generator) -> Array:
        """Return posterior draws (n, M, D), given data vector ``column`` of the block."""
        # √(ρ/h) f̃_* + K_* K⁻¹ (z − √(ρ/h) z̃)
        data, curves = self._simulate(n_samples, rng)
        scale = np.sqrt(self.block.variance_scale)
        correction = self._mean_given(self.block.data[column] - scale * data)
        return np.asarray(scale * curves + correction.transpose(0, 2, 1))

    def _mean_given(self, data: Array) -> Array:
        """Return K_* K⁻¹ z for data vectors (k, P, D, N), (k, D, M)."""
        posterior = self.solver.condition(replace(self.block, data=data), self.parameters)
        mean, _ = posterior.predict(self.target, self.times)
        return mean

    def _prior(self) -> Array:
        """Return K_**, (D M, D M)."""
        size = len(self.parameters.log_noise) * len(self.times)
        total = np.zeros((size, size))
        for name in self.block.units:
            covariance = self._layer(name, self.times).reshape(size, size)
            total += self.target.prior_scale(name) * covariance
        return total

    def _cross(self) -> Array:
        """Return the rows of K_* as data vectors, (D M, P, D, N), 0 where hidden."""
        observed = self.block.observed
        cross = np.zeros((observed.shape[1] * len(self.times), *observed.shape))
        for name, factor in self.block.units.items():
            covariance = self._layer(name, self.block.times)
            by_row = covariance.reshape(len(cross), 1, *observed.shape[1:])
            cross += (factor @ self.target.weights[name])[:, None, None] * by_row
        return np.where(observed, cross, 0.0)

    def _simulate(self, n_samples: int, rng: np.random.Generator) -> tuple[Array, Array]:
        """Return joint prior draws of data vectors (n, P, D, N) and of the target (n, M, D)."""
        block, times = self.block, np.concatenate([self.block.times, self.times])
        n_entries = len(block.times)  # drawn together, so that equal times get equal values
        # The noise of the data, then the layers' draws in data and target.
        noise = np.sqrt(self.parameters.noise[:, None] * block.noise_scale)
        data = noise * rng.standard_normal((n_samples, *noise.shape))
        curves = np.zeros((n_samples, len(self.times), noise.shape[1]))
        for name, factor in block.units.items():
            draws = self._draw_layer(name, times, n_samples * factor.shape[1], rng)
            draws = draws.reshape(n_samples, factor.shape[1], *draws.shape[1:])
            data += np.einsum("pi,nitd->npdt", factor, draws[:, :, :n_entries])
            curves += np.einsum("i,nitd->ntd", self.target.weights[name], draws[:, :, n_entries:])
        for name, variance in self.target.independent_variance.items():
            draws = self._draw_layer(name, times, n_samples, rng)
            curves += np.sqrt(variance) * draws[:, n_entries:]
        return np.where(block.observed, data, 0.0), curves

    def _draw_layer(
        self, name: str, times: Array, n_samples: int, rng: np.random.Generator
    ) -> Array:
        """Return (n, M, D) draws of a layer at ``times`` (M,)."""
        layer = self.parameters.layers[name]
        return draw_layer(self.solver.kernel, layer, times, n_samples, rng)

    def _layer(self, name: str, others: Array) -> Array:
        """Return Σ_q B_q ⊗ k_q of a layer between the times and ``others`` (N,), (D, M, D, N)."""
        lags = np.subtract.outer(self.times, others)
        return self.parameters.layers[name].covariance(self.solver.kernel, lags)
