"""Models that draw new recordings from their latent dynamics (GPDM §5.1).

Wang, Fleet and Hertzmann (2008), *Gaussian Process Dynamical Models for Human Motion*, IEEE TPAMI
30(2), is cited as GPDM.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_rates
from mocapbench.baselines.common.validation import check_count, check_sampling, check_seed
from mocapbench.baselines.gpdm.hmc import HybridMonteCarlo
from mocapbench.baselines.gpdm.latent_variable_model import LatentVariableModel
from mocapbench.baselines.gpdm.rollout import fair_trajectories, mean_trajectory
from mocapbench.baselines.protocols import Dynamical, SampleByFrameByChannel, Synthesiser
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Frames, Recording

__all__ = ["DynamicalModel"]


_MOST_FRAMES = 10_000
"""A covariance of as many takes 0.8 GB."""

# §5.1 has 40 burn-in samples.
_BURN_IN, _LEAPS, _STEP = 40, 20, 1e-2


class DynamicalModel(LatentVariableModel, Synthesiser, Dynamical):
    """A latent variable model in which each position depends on the ``order`` positions before it.

    Trajectories are drawn by hybrid Monte Carlo chains of a few dozen states, which mix slowly:
    samples vary less around the mean prediction than exact draws would.
    """

    order: int
    """Number of previous positions on which the next one depends."""

    def _check_recordings(self, recordings: Sequence[Recording]) -> tuple[Recording, ...]:
        checked = super()._check_recordings(recordings)
        check_rates(recordings)
        return checked

    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return samples of whole recordings at ``times`` (N,), noise included: (n, N, D).

        Each starts at the first position of a random training sequence. Trajectories are drawn by
        hybrid Monte Carlo (GPDM §5.1), and poses from their joint distribution given the
        trajectory, at the training frame rate and then interpolated linearly. What it costs
        depends on the frames at that rate from the first to the last of ``times``, however few
        these are: time grows with their cube (600 take some 20 s for each training sequence drawn),
        memory with their square.

        Raises
        ------
        ValueError
            If times do not increase or span more than 10 000 frames, or the number of samples or
            the seed is invalid.
        """
        check_is_fitted(self)
        times = check_sampling(times, n_samples, random_state)
        rng = np.random.default_rng(random_state)
        n_frames = max(self._n_frames(times), self.order + 1)
        grid = times[0] + self.frame_seconds_ * np.arange(n_frames)
        drawn = (
            self._restore_units(self._poses(x, rng))
            for x in self._draw_trajectories(n_samples, n_frames, rng)
        )
        return np.stack([_interpolate_columns(times, grid, values) for values in drawn])

    def _n_frames(self, times: Frames) -> int:
        """Return how many frames at the training rate cover ``times``."""
        n_frames = np.ceil((times[-1] - times[0]) / self.frame_seconds_ - 1e-6) + 1
        if n_frames > _MOST_FRAMES:
            raise ValueError(
                f"expected times that span at most {_MOST_FRAMES} frames of the training rate, "
                f"{self.frame_seconds_:g} s each, got {n_frames:.0f}; draw a shorter recording"
            )
        return int(n_frames)

    def latent_walks(
        self, n_frames: int, n_samples: int, random_state: int | np.random.Generator
    ) -> tuple[Array, Array]:
        """Return the mean prediction (N, d) and samples (n, N, d) from the first training frame."""
        check_is_fitted(self)
        for name, value in (("n_frames", n_frames), ("n_samples", n_samples)):
            check_count(name, value, 1)
        check_seed("random_state", random_state)
        dynamics, first = self.conditional_.dynamics, self._first(self._origins()[0])
        sampler = HybridMonteCarlo(n_samples, _BURN_IN, _LEAPS, _STEP)
        rng = np.random.default_rng(random_state)
        samples = fair_trajectories(dynamics, first, n_frames, sampler, rng)
        return mean_trajectory(dynamics, first, n_frames), samples

    def _origins(self) -> NDArray[np.intp]:
        """Return the indices of training sequences that have at least ``order`` frames."""
        return np.flatnonzero(np.asarray(self.sequences_.lengths) >= self.order)

    def _first(self, sequence: int) -> Array:
        """Return the first positions (order, d) of a training sequence."""
        starts = np.cumsum((0, *self.sequences_.lengths))
        return self.estimate_.x[starts[sequence] : starts[sequence + 1]][: self.order]

    def _draw_trajectories(
        self, n_samples: int, n_frames: int, rng: np.random.Generator
    ) -> list[Array]:
        """Return trajectories (N, d), from one chain for each training sequence drawn."""
        origins = rng.choice(self._origins(), n_samples)
        chains = []
        for sequence, count in zip(*np.unique(origins, return_counts=True), strict=True):
            sampler = HybridMonteCarlo(int(count), _BURN_IN, _LEAPS, _STEP)
            first = self._first(int(sequence))
            chains += [
                *fair_trajectories(self.conditional_.dynamics, first, n_frames, sampler, rng)
            ]
        return chains

    def _poses(self, x: Array, rng: np.random.Generator) -> Array:
        """Return poses in the model's units, drawn jointly at the positions ``x`` (M, d)."""
        mean, covariance, _ = self.conditional_.reconstruction.moments(x)
        values, vectors = np.linalg.eigh(covariance)
        # The symmetric root, which no sign of an eigenvector changes.
        root = vectors * np.sqrt(np.maximum(values, 0.0)) @ vectors.T
        return np.asarray(mean + root @ rng.standard_normal(mean.shape))


def _interpolate_columns(times: Frames, grid: Frames, values: Array) -> Array:
    return np.stack([np.interp(times, grid, column) for column in values.T], axis=1)
