"""Models that draw new recordings from their latent dynamics (GPDM §5.1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.gpdm.estimator import LatentVariableModel
from mocapbench.baselines.gpdm.hmc import HybridMonteCarlo
from mocapbench.baselines.gpdm.rollout import fair_trajectories, mean_trajectory
from mocapbench.baselines.protocols import Dynamical, SampleByFrameByChannel, Synthesiser
from mocapbench.datasets import Frames

__all__ = ["DynamicalModel"]

Array = NDArray[np.float64]

# §5.1 has 40 burn-in samples.
_BURN_IN, _LEAPS, _STEP = 40, 20, 1e-2


class DynamicalModel(LatentVariableModel, Synthesiser, Dynamical):
    """A latent variable model whose positions depend on ``order`` ones before.

    Trajectories come from Markov chains of a few dozen states, which mix slowly: samples are less
    spread around the mean prediction than the dynamics would have them.
    """

    order: int

    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return fair samples of whole recordings, each from the start of a training sequence.

        Trajectories are drawn by hybrid Monte Carlo (§5.1), poses at once from their joint
        distribution given the trajectory, at the frame rate of training and then interpolated.
        """
        check_is_fitted(self)
        rng = np.random.default_rng(random_state)
        n_frames = int(np.ceil((times[-1] - times[0]) / self.frame_seconds_ - 1e-6)) + 1
        n_frames = max(n_frames, self.order + 1)
        grid = times[0] + self.frame_seconds_ * np.arange(n_frames)
        drawn = (self._unscaled(self._poses(x, rng)) for x in self._drawn(n_samples, n_frames, rng))
        return np.stack([_interpolated(times, grid, values) for values in drawn])

    def latent_walks(
        self, n_frames: int, n_samples: int, random_state: int | np.random.Generator
    ) -> tuple[Array, Array]:
        """Return the mean prediction (N, d) from the first training frame, and fair samples."""
        check_is_fitted(self)
        motion, first = self.conditional_.motion, self._first(self._origins()[0])
        sampler = HybridMonteCarlo(n_samples, _BURN_IN, _LEAPS, _STEP, _BURN_IN)
        rng = np.random.default_rng(random_state)
        samples = fair_trajectories(motion, first, n_frames, sampler, rng)
        return mean_trajectory(motion, first, n_frames), samples

    def _origins(self) -> NDArray[np.intp]:
        """Return the training sequences that are long enough to start from."""
        return np.flatnonzero(np.asarray(self.sequences_.lengths) >= self.order)

    def _first(self, sequence: int) -> Array:
        """Return the first positions (order, d) of a training sequence that has so many."""
        starts = np.cumsum((0, *self.sequences_.lengths))
        return self.estimate_.x[starts[sequence] : starts[sequence + 1]][: self.order]

    def _drawn(self, n_samples: int, n_frames: int, rng: np.random.Generator) -> list[Array]:
        """Return trajectories, those that start from one training sequence from one chain."""
        origins = rng.choice(self._origins(), n_samples)
        chains = []
        for sequence, count in zip(*np.unique(origins, return_counts=True), strict=True):
            sampler = HybridMonteCarlo(int(count), _BURN_IN, _LEAPS, _STEP, _BURN_IN)
            first = self._first(int(sequence))
            chains += [*fair_trajectories(self.conditional_.motion, first, n_frames, sampler, rng)]
        return chains

    def _poses(self, x: Array, rng: np.random.Generator) -> Array:
        """Return poses in the model's units, drawn jointly at the positions ``x`` (M, d)."""
        mean, covariance, _ = self.conditional_.reconstruction.moments(x)
        values, vectors = np.linalg.eigh(covariance)
        root = vectors * np.sqrt(np.maximum(values, 0.0))
        return np.asarray(mean + root @ rng.standard_normal(mean.shape))


def _interpolated(times: Frames, grid: Frames, values: Array) -> Array:
    return np.stack([np.interp(times, grid, column) for column in values.T], axis=1)
