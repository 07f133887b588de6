"""A trained process and its recordings: inference of curves in the outputs' own units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from mocapbench.baselines.common.scaling import Standardisation
from mocapbench.baselines.gp.planner import with_mapper
from mocapbench.baselines.gp.posterior.joint import draw_curves, joint_covariance
from mocapbench.baselines.gp.posterior.prediction import infer
from mocapbench.baselines.gp.posterior.sampling import draw_layer
from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.reduction.reduction import PosteriorTerm, Reduction
from mocapbench.baselines.gp.solvers.solver import Solver
from mocapbench.baselines.gp.threads import Mapper
from mocapbench.baselines.protocols import SampleByFrameByChannel
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Frames

__all__ = ["FittedProcess"]


@dataclass(frozen=True, eq=False)
class FittedProcess:
    """A trained process, given its recordings.

    All times are in seconds and in any order. Observation noise is left out unless a method says
    otherwise.

    Parameters
    ----------
    kernel : StationaryKernel
        The kernel of every component.
    reduction : Reduction
        The likelihood as block problems.
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

    def with_mapper(self, mapper: Mapper) -> Self:
        """Return the same process, whose solvers call functions of outputs through ``mapper``."""
        return replace(self, solvers=with_mapper(self.solvers, mapper))

    def infer(
        self, curves: Sequence[tuple[PosteriorTerm, ...]], times: Sequence[Frames]
    ) -> list[tuple[FrameByChannel, FrameByChannel]]:
        """Return the posterior mean and variance of every curve at its times: (M, D) each."""
        inferred = infer(self.reduction, self.solvers, self.parameters, curves, times)
        return [
            (self.scaling.restore(mean), variance * self.scaling.scale**2)
            for mean, variance in inferred
        ]

    def joint_covariance(self, curve: tuple[PosteriorTerm, ...], times: Frames) -> Array:
        """Return the posterior covariance of a curve, (D M, D M), outputs slowest."""
        joint = joint_covariance(self.reduction, self.solvers, self.parameters, curve, times)
        scale = np.repeat(self.scaling.scale, len(times))
        return joint * np.outer(scale, scale)

    def draw(
        self,
        curve: tuple[PosteriorTerm, ...],
        times: Frames,
        n_samples: int,
        rng: np.random.Generator,
    ) -> SampleByFrameByChannel:
        """Return posterior draws of a curve, (n, M, D)."""
        draws = draw_curves(
            self.reduction,
            self.solvers,
            self.parameters,
            curve,
            times,
            n_samples=n_samples,
            rng=rng,
        )
        return self.scaling.restore(draws)

    def draw_recordings(
        self,
        layers: Sequence[str],
        trend: FrameByChannel,
        times: Frames,
        n_samples: int,
        rng: np.random.Generator,
    ) -> SampleByFrameByChannel:
        """Return new recordings: a trend (M, D), plus draws of layers and noise: (n, M, D)."""
        draws = np.zeros((n_samples, len(times), len(self.parameters.log_noise)))
        for layer in layers:
            draws += draw_layer(self.kernel, self.parameters.layers[layer], times, n_samples, rng)
        draws += np.sqrt(self.parameters.noise) * rng.standard_normal(draws.shape)
        return trend + self.scaling.scale * draws

    def prior_covariance(self, layer: str, times: Frames) -> Array:
        """Return Σ_q B_q ⊗ k_q of a layer, (D M, D M), outputs slowest."""
        lags = np.subtract.outer(times, times)
        covariance = self.parameters.layers[layer].covariance(self.kernel, lags)
        scale = np.repeat(self.scaling.scale, len(times))
        return covariance.reshape(len(scale), -1) * np.outer(scale, scale)
