r"""A fitted Gaussian process as a value: what it says of curves, given its recordings.

A curve is a sum of independent terms (`Target`), each given by one block: that of a
recording, of the trend, or of a group in between (`Reduction`). See docs/mathematics/prediction.md,
section 8.

Conditioning is linear in the data, so posterior means of suitable data vectors are all that is
needed of a solver for joint posteriors (docs/mathematics/prediction.md, sections 8 and 9). A target
of a block, with values :math:`f_*` at the requested times and cross covariance :math:`K_*` with the
visible entries, has

* the posterior covariance :math:`\tfrac{\rho}{h}(K_{**} - K_* K^{-1} K_*^\top)`, where
  :math:`K_* K^{-1} K_*^\top` is the posterior mean given the columns of :math:`K_*^\top` as data;
* the posterior draw :math:`\sqrt{\rho/h}\, \tilde f_* + K_* K^{-1}(z - \sqrt{\rho/h}\, \tilde z)`,
  where :math:`(\tilde z, \tilde f_*)` is a draw of the data and the target from the prior.

The second is Matheron's rule (Wilson et al. 2021, *Pathwise Conditioning of Gaussian Processes*,
JMLR 22, Theorem 1). It needs draws of the layers at the times, but no joint covariance.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Self

import numpy as np
from joblib import effective_n_jobs

from mocapbench.baselines.common.scaling import Standardisation
from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.reduction.reduction import Reduction
from mocapbench.baselines.gp.solvers.block import Target
from mocapbench.baselines.gp.solvers.planner import PLANS, with_mapper
from mocapbench.baselines.gp.solvers.solver import BlockPosterior, Solver, thread_mapper
from mocapbench.baselines.protocols import SampleByFrameByChannel
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Frames

__all__ = ["TRENDS", "Curve", "FittedProcess"]


Curve = tuple[Target, ...]
"""The terms of a noise-free curve."""


@dataclass(frozen=True, eq=False)
class FittedProcess:
    """A Gaussian process with its parameters, given recordings.

    Times are in seconds and in any order, results in the outputs' own units. Observation noise is
    left out unless a method says otherwise.

    Parameters
    ----------
    kernel : StationaryKernel
        The kernel of every component.
    reduction : Reduction
        The likelihood of the recordings as block problems, and the terms of their curves.
    solvers : tuple of Solver
        One for each block.
    parameters : Parameters
        For outputs in standard units.
    scaling : Standardisation
        The map to standard units.
    """

    kernel: StationaryKernel
    reduction: Reduction
    solvers: tuple[Solver, ...]
    parameters: Parameters
    scaling: Standardisation

    @property
    def noise(self) -> Array:
        """(D,) noise variance of each output."""
        return self.parameters.noise * self.scaling.scale**2

    @property
    def coregionalisation(self) -> Mapping[str, Array]:
        """The matrices B_q of each layer by its name, (Q, D, D)."""
        units = np.outer(self.scaling.scale, self.scaling.scale)
        layers = self.parameters.layers.items()
        return {name: layer.matrices * units for name, layer in layers}

    def layer_covariance(self, layer: str, times: Frames) -> Array:
        """Return the prior covariance Σ_q B_q ⊗ k_q of a layer, (D M, D M), outputs slowest."""
        lags = np.subtract.outer(times, times)
        covariance = self.parameters.layers[layer].covariance(self.kernel, lags)
        scale = np.repeat(self.scaling.scale, len(times))
        return covariance.reshape(len(scale), -1) * np.outer(scale, scale)

    @contextmanager
    def threaded(self, n_jobs: int | None) -> Iterator[Self]:
        """Give the same process, whose solvers share their outputs out to ``n_jobs`` threads."""
        with thread_mapper(effective_n_jobs(n_jobs)) as mapper:
            yield replace(self, solvers=with_mapper(self.solvers, mapper))

    def condition(self, reduction: Reduction) -> Self:
        """Return the process given other recordings, its parameters kept."""
        # They may break what the solver of `fit` needs, such as gaps that all outputs share.
        solvers = PLANS["auto"](self.kernel, reduction.blocks, self.parameters)
        return replace(self, reduction=reduction, solvers=solvers)

    def infer(
        self, curves: Sequence[Curve], times: Sequence[Frames]
    ) -> list[tuple[FrameByChannel, FrameByChannel]]:
        """Return the posterior mean and variance of every curve at its times: (M, D) each.

        Every block that is needed is conditioned once.
        """
        posteriors = {
            index: self.solvers[index].condition(self.reduction.blocks[index], self.parameters)
            for index in sorted({term.block for curve in curves for term in curve})
        }
        return [
            self._add_terms(posteriors, curve, at) for curve, at in zip(curves, times, strict=True)
        ]

    def covariance(self, curve: Curve, times: Frames) -> Array:
        """Return the posterior covariance of a curve, (D M, D M), outputs slowest.

        It is symmetric, and positive semi-definite up to rounding. Each of the curve's blocks is
        conditioned once, on D M data vectors.
        """
        scale = np.repeat(self.scaling.scale, len(times))
        total = np.zeros((len(scale), len(scale)))
        for term in curve:
            total += self._term_covariance(term, times)
        return 0.5 * (total + total.T) * np.outer(scale, scale)

    def draw(
        self, curve: Curve, times: Frames, n_samples: int, rng: np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return posterior draws of a curve, (n, M, D); equal times get equal values.

        Each of the curve's blocks is conditioned once, on n data vectors. The draws of a seed
        depend on the set of times, but not on their order, nor on the solvers except for rounding.
        """
        total = np.zeros((n_samples, len(times), len(self.scaling.scale)))
        for term in curve:
            total += self._draw_term(term, times, n_samples, rng)
        return self.scaling.restore(total)

    def draw_recordings(
        self, trend: str, times: Frames, n_samples: int, rng: np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return new recordings, noise included: (n, M, D).

        They are one of the `TRENDS`, plus draws of the layers below it, or of the only layer.
        """
        around = TRENDS[trend](self, times, rng)
        top, *below = self.parameters.layers.values()
        draws = np.zeros((n_samples, len(times), len(self.scaling.scale)))
        for layer in below or [top]:
            draws += layer.draw(self.kernel, times, n_samples, rng)
        draws += np.sqrt(self.parameters.noise) * rng.standard_normal(draws.shape)
        return around + self.scaling.scale * draws

    def _add_terms(
        self, posteriors: Mapping[int, BlockPosterior], curve: Curve, times: Frames
    ) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the mean and the variance (M, D) of the sum of a curve's independent terms."""
        mean, variance = np.zeros((2, len(times), len(self.scaling.scale)))
        for term in curve:
            means, term_variance = posteriors[term.block].predict(term, times)
            mean += means[term.column].T
            variance += term_variance.T
        return self.scaling.restore(mean), variance * self.scaling.scale**2

    def _term_covariance(self, term: Target, times: Frames) -> Array:
        """Return the posterior covariance of a term, (D M, D M), outputs slowest."""
        block, size = self.reduction.blocks[term.block], len(self.scaling.scale) * len(times)
        # K_**, and (ρ / h) (K_** − K_* K⁻¹ K_*ᵀ)
        prior = np.zeros((size, size))
        for name in block.units:
            covariance = self._layer_between(name, times, times).reshape(size, size)
            prior += term.prior_scale(name) * covariance
        explained = self._mean_given(self._cross(term, times), term, times).reshape(size, size)
        return np.asarray(block.variance_scale * (prior - explained))

    def _draw_term(
        self, term: Target, times: Frames, n_samples: int, rng: np.random.Generator
    ) -> Array:
        """Return posterior draws of a term, (n, M, D)."""
        block = self.reduction.blocks[term.block]
        # √(ρ/h) f̃_* + K_* K⁻¹ (z − √(ρ/h) z̃)
        data, curves = self._simulate(term, times, n_samples, rng)
        scale = np.sqrt(block.variance_scale)
        correction = self._mean_given(block.data[term.column] - scale * data, term, times)
        return np.asarray(scale * curves + correction.transpose(0, 2, 1))

    def _mean_given(self, data: Array, term: Target, times: Frames) -> Array:
        """Return K_* K⁻¹ z for data vectors (k, P, D, N), (k, D, M)."""
        block, solver = self.reduction.blocks[term.block], self.solvers[term.block]
        posterior = solver.condition(replace(block, data=data), self.parameters)
        mean, _ = posterior.predict(term, times)
        return mean

    def _cross(self, term: Target, times: Frames) -> Array:
        """Return the rows of K_* as data vectors, (D M, P, D, N), 0 where hidden."""
        block = self.reduction.blocks[term.block]
        cross = np.zeros((block.observed.shape[1] * len(times), *block.observed.shape))
        for name, factor in block.units.items():
            covariance = self._layer_between(name, times, block.times)
            by_row = covariance.reshape(len(cross), 1, *block.observed.shape[1:])
            cross += (factor @ term.weights[name])[:, None, None] * by_row
        return np.where(block.observed, cross, 0.0)

    def _simulate(
        self, term: Target, times: Frames, n_samples: int, rng: np.random.Generator
    ) -> tuple[Array, Array]:
        """Return joint prior draws of data vectors (n, P, D, N) and of the target (n, M, D)."""
        block = self.reduction.blocks[term.block]
        # Drawn together, so that equal times get equal values.
        at, n_entries = np.concatenate([block.times, times]), len(block.times)
        # The noise of the data, then the layers' draws in data and target.
        noise = np.sqrt(self.parameters.noise[:, None] * block.noise_scale)
        data = noise * rng.standard_normal((n_samples, *noise.shape))
        curves = np.zeros((n_samples, len(times), noise.shape[1]))
        for name, factor in block.units.items():
            draws = self._draw_layer(name, at, n_samples * factor.shape[1], rng)
            draws = draws.reshape(n_samples, factor.shape[1], *draws.shape[1:])
            data += np.einsum("pi,nitd->npdt", factor, draws[:, :, :n_entries])
            curves += np.einsum("i,nitd->ntd", term.weights[name], draws[:, :, n_entries:])
        for name, variance in term.independent_variance.items():
            draws = self._draw_layer(name, at, n_samples, rng)
            curves += np.sqrt(variance) * draws[:, n_entries:]
        return np.where(block.observed, data, 0.0), curves

    def _draw_layer(
        self, name: str, times: Frames, n_samples: int, rng: np.random.Generator
    ) -> Array:
        """Return (n, M, D) draws of a layer."""
        return self.parameters.layers[name].draw(self.kernel, times, n_samples, rng)

    def _layer_between(self, name: str, times: Frames, others: Frames) -> Array:
        """Return Σ_q B_q ⊗ k_q of a layer between times (M,) and others (N,), (D, M, D, N)."""
        lags = np.subtract.outer(times, others)
        return self.parameters.layers[name].covariance(self.kernel, lags)


Trend = Callable[[FittedProcess, Frames, np.random.Generator], FrameByChannel]
"""Gives the trend of a fitted process at times (M,): (M, D)."""


def _infer_trend(process: FittedProcess, times: Frames, rng: np.random.Generator) -> FrameByChannel:
    del rng  # nothing is drawn
    ((mean, _),) = process.infer([process.reduction.trend], [times])
    return mean


def _draw_trend(process: FittedProcess, times: Frames, rng: np.random.Generator) -> FrameByChannel:
    (trend,) = process.draw(process.reduction.trend, times, 1, rng)
    return np.asarray(trend)


TRENDS: Mapping[str, Trend] = MappingProxyType({"mean": _infer_trend, "posterior": _draw_trend})
"""What new recordings are drawn around: the trend's posterior mean, or one draw from its posterior.

J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017, §5.2, takes the mean as if it were known. New
recordings then resemble each other, and the fitted recordings, a little more than they should.
Around a draw, a set of new recordings is an exact draw of further replicates given all visible
entries (docs/mathematics/prediction.md, section 9).
"""
