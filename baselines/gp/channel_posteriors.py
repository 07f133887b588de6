"""What models with one Gaussian process for each channel predict and draw."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.validation import check_count, check_sampling, check_seed
from mocapbench.baselines.gp.conditioned import Conditioned
from mocapbench.baselines.gp.estimator import GaussianProcess
from mocapbench.baselines.protocols import (
    Prediction,
    SampleByFrameByChannel,
    Synthesiser,
)
from mocapbench.baselines.rehearsal.left_out import LeftOut, side_by_side
from mocapbench.datasets import Frames, Recording

__all__ = ["ChannelPosteriors", "Single"]

Single = TypeVar("Single", bound=GaussianProcess)
"""The model of one channel."""


class ChannelPosteriors(Conditioned, Synthesiser, Generic[Single]):
    """The fitted models of all channels, side by side; channels are independent."""

    channels_: tuple[str, ...]
    units_: tuple[str, ...]
    models_: tuple[Single, ...]

    def left_out(self, recordings: Sequence[Recording]) -> list[LeftOut]:
        """Return the posteriors of recordings, and the errors of their visible entries."""
        self._check_given(recordings)
        by_channel = [
            model.left_out([recording.select([channel]) for recording in recordings])
            for channel, model in zip(self.channels_, self.models_, strict=True)
        ]
        return [LeftOut.side_by_side(channels) for channels in zip(*by_channel, strict=True)]

    def as_tried(self, trials: Sequence[Recording]) -> list[Prediction]:
        """Return what the models claim of recordings of which more is hidden."""
        self._check_given(trials)
        by_channel = [
            model.as_tried([trial.select([channel]) for trial in trials])
            for channel, model in zip(self.channels_, self.models_, strict=True)
        ]
        return [side_by_side(channels) for channels in zip(*by_channel, strict=True)]

    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return draws of new recordings, noise included, as `MOHGP.sample` does.

        Parameters
        ----------
        times : ndarray of shape (N,)
            In seconds, in any order.
        n_samples : int
            Number n of recordings.
        random_state : int or numpy.random.Generator
            Seed of the draws.

        Returns
        -------
        ndarray of shape (n, N, D)
            In the channels' own units.

        Raises
        ------
        sklearn.exceptions.NotFittedError
            If `fit` has not been called.
        ValueError
            If the number of recordings is not a positive integer, or times or the seed are invalid.
        """
        check_is_fitted(self)
        check_sampling(times, n_samples, random_state, increasing=False)
        rng = np.random.default_rng(random_state)
        return np.dstack([model.sample(times, n_samples, rng) for model in self.models_])

    def posterior_covariance(
        self, recording: Recording, times: Frames | None = None
    ) -> NDArray[np.float64]:
        """Return the joint covariance of a recording's curve given all visible entries.

        Noise is left out. Covariances between different channels are 0.

        Parameters
        ----------
        recording : Recording
            One that was given to `fit`.
        times : ndarray of shape (M,), optional
            In seconds, in any order; the recording's times if left out.

        Returns
        -------
        ndarray of shape (D M, D M)
            In the channels' own units, with channels slowest.

        Raises
        ------
        sklearn.exceptions.NotFittedError
            If `fit` has not been called.
        ValueError
            If the recording was not given to `fit`, or not with these times and values.
        """
        self._check_given([recording])
        return np.asarray(
            block_diag(
                *(
                    model.posterior_covariance(recording.select([channel]), times)
                    for channel, model in zip(self.channels_, self.models_, strict=True)
                )
            )
        )

    def posterior_draws(
        self,
        recording: Recording,
        n_samples: int,
        random_state: int | np.random.Generator,
        times: Frames | None = None,
    ) -> SampleByFrameByChannel:
        """Return draws of a recording's curve given all visible entries, without noise.

        Parameters
        ----------
        recording : Recording
            One that was given to `fit`.
        n_samples : int
            Number n of draws.
        random_state : int or numpy.random.Generator
            Seed of the draws.
        times : ndarray of shape (M,), optional
            In seconds, in any order; the recording's times if left out.

        Returns
        -------
        ndarray of shape (n, M, D)
            In the channels' own units.

        Raises
        ------
        sklearn.exceptions.NotFittedError
            If `fit` has not been called.
        ValueError
            If the recording was not given to `fit`, or not with these times and values, or the
            number of draws or the seed is invalid.
        """
        self._check_given([recording])
        check_count("n_samples", n_samples, 1)
        check_seed("random_state", random_state)
        rng = np.random.default_rng(random_state)
        return np.dstack(
            [
                model.posterior_draws(recording.select([channel]), n_samples, rng, times)
                for channel, model in zip(self.channels_, self.models_, strict=True)
            ]
        )
