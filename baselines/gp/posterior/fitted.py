"""A process whose parameters are known, given its recordings: curves in the outputs' own units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.scaling import Standardisation
from mocapbench.baselines.common.threads import Mapper
from mocapbench.baselines.gp.planner import with_mapper
from mocapbench.baselines.gp.posterior.joint import draw_curves, joint_covariance
from mocapbench.baselines.gp.posterior.prediction import infer
from mocapbench.baselines.gp.posterior.sampling import draw_layer
from mocapbench.baselines.gp.prior.kernels import Kernel
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.reduction.reduction import Reduction, Share
from mocapbench.baselines.gp.solvers.solver import Solver
from mocapbench.baselines.protocols import SampleByFrameByChannel
from mocapbench.datasets import FrameByChannel, Frames

__all__ = ["FittedProcess"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class FittedProcess:
    """Everything that inference after training needs. Noise is left out unless said otherwise.

    Parameters
    ----------
    kernel : Kernel
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

    kernel: Kernel
    reduction: Reduction
    solvers: tuple[Solver, ...]
    parameters: Parameters
    scaling: Standardisation

    def working_with(self, mapper: Mapper) -> Self:
        """Return the same process, whose solvers call functions of outputs through ``mapper``."""
        return replace(self, solvers=with_mapper(self.solvers, mapper))

    def infer(
        self, curves: Sequence[tuple[Share, ...]], times: Sequence[Frames]
    ) -> list[tuple[FrameByChannel, FrameByChannel]]:
        """Return posterior mean and variance, (M, D) each, of curves at times of their own."""
        inferred = infer(self.reduction, self.solvers, self.parameters, curves, times)
        return [
            (self.scaling.restore(mean), variance * self.scaling.scale**2)
            for mean, variance in inferred
        ]

    def joint_covariance(self, curve: tuple[Share, ...], times: Frames) -> Array:
        """Return the posterior covariance of a curve, (D M, D M), outputs slowest."""
        joint = joint_covariance(self.reduction, self.solvers, self.parameters, curve, times)
        scale = np.repeat(self.scaling.scale, len(times))
        return joint * np.outer(scale, scale)

    def draw(
        self, curve: tuple[Share, ...], times: Frames, n_samples: int, rng: np.random.Generator
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

    def observe_new(
        self,
        layers: Sequence[str],
        trend: FrameByChannel,
        times: Frames,
        n_samples: int,
        rng: np.random.Generator,
    ) -> SampleByFrameByChannel:
        """Return draws of layers around a trend (M, D), with noise: (n, M, D)."""
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
