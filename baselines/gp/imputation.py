"""What a trained model predicts: posteriors of the recordings that it was fitted to."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence

import numpy as np

from mocapbench.baselines.common.validation import check_count, check_seed, check_times
from mocapbench.baselines.gp.conditioned import Conditioned
from mocapbench.baselines.gp.covariances import LearntCovariances
from mocapbench.baselines.gp.posterior.fitted import FittedProcess
from mocapbench.baselines.gp.reduction.reduction import PosteriorTerm, Reduction
from mocapbench.baselines.protocols import Prediction, SampleByFrameByChannel
from mocapbench.baselines.rehearsal.left_out import LeftOut
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Frames, Recording

__all__ = ["RecordingPosterior"]


class RecordingPosterior(LearntCovariances, Conditioned):
    """A trained model that conditions on the recordings given to `fit`."""

    channels_: tuple[str, ...]
    units_: tuple[str, ...]
    recordings_: Mapping[str, Recording]
    reduction_: Reduction

    def left_out(self, recordings: Sequence[Recording]) -> list[LeftOut]:
        """Return the posteriors of recordings, and the errors of their visible entries."""
        self._check_given(recordings)
        terms = [self._terms(recording) for recording in recordings]
        with self._threaded_process() as process:
            curves = process.infer(terms, [recording.times for recording in recordings])
        return [
            LeftOut.of(recording, mean, variance, self.noise_, self.scaling_.scale)
            for recording, (mean, variance) in zip(recordings, curves, strict=True)
        ]

    def as_tried(self, trials: Sequence[Recording]) -> list[Prediction]:
        """Return what the process claims of recordings given to `fit` of which more is hidden."""
        self._check_given(trials)
        return [self._tried(trial) for trial in trials]

    def posterior_covariance(self, recording: Recording, times: Frames | None = None) -> Array:
        """Return the joint covariance of a recording's curve given all visible entries.

        Noise is left out: for observations add `noise_` to the diagonal.

        Parameters
        ----------
        recording : Recording
            One that was given to `fit`.
        times : ndarray of shape (M,), optional
            In seconds, in any order; the recording's times if left out.

        Returns
        -------
        ndarray of shape (D M, D M)
            In the outputs' own units; outputs are slowest, as in `covariance`. Symmetric, and
            positive semi-definite up to rounding. It takes memory for D M data vectors; if only
            draws of the curve are needed, `posterior_draws` is cheaper.

        Raises
        ------
        sklearn.exceptions.NotFittedError
            If `fit` has not been called.
        ValueError
            If the recording was not given to `fit`, or not with these times and values.
        """
        self._check_given([recording])
        curve, times = self._terms(recording), self._process_times(recording, times)
        with self._threaded_process() as process:
            return process.joint_covariance(curve, times)

    def posterior_draws(
        self,
        recording: Recording,
        n_samples: int,
        random_state: int | np.random.Generator,
        times: Frames | None = None,
    ) -> SampleByFrameByChannel:
        """Return draws of a recording's curve given all visible entries.

        Noise is left out. A draw is one function of time, at hidden and at visible entries.

        Parameters
        ----------
        recording : Recording
            One that was given to `fit`.
        n_samples : int
            Number n of draws.
        random_state : int or numpy.random.Generator
            Seed of the draws; rounding aside, they do not depend on the solver.
        times : ndarray of shape (M,), optional
            In seconds, in any order; the recording's times if left out.

        Returns
        -------
        ndarray of shape (n, M, D)
            In the outputs' own units.

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
        curve, times = self._terms(recording), self._process_times(recording, times)
        with self._threaded_process() as process:
            return process.draw(curve, times, n_samples, np.random.default_rng(random_state))

    @abstractmethod
    def _showing(self, number: int, trial: Recording) -> FittedProcess:
        """Return the process, parameters kept, to which recording ``number`` shows a trial."""

    def _tried(self, trial: Recording) -> Prediction:
        if trial.visible.all():
            return Prediction.around(trial, trial.values, np.zeros_like(trial.values))
        number = self._number(trial)
        with self._threaded(self._showing(number, trial)) as process:
            curve = process.reduction.replicates[number]
            ((mean, variance),) = process.infer([curve], [trial.times])
        return Prediction.around(trial, mean, variance + self.noise_)

    def _terms(self, recording: Recording) -> tuple[PosteriorTerm, ...]:
        """Return the posterior terms of a recording that was given to `fit`."""
        number = self._number(recording)
        self._check_unchanged(recording)
        return self.reduction_.replicates[number]

    def _process_times(self, recording: Recording, times: Frames | None) -> Frames:
        """Return the times of the process at which a recording has ``times``, or its own."""
        return recording.times if times is None else check_times(times)

    def _number(self, recording: Recording) -> int:
        """Return the place among the recordings given to `fit` of the one of that name."""
        if recording.name not in self.recordings_:
            raise ValueError(
                f"expected recordings that were given to fit, {sorted(self.recordings_)}, got "
                f"{recording.name!r}: give it to fit together with the others"
            )
        return list(self.recordings_).index(recording.name)

    def _check_unchanged(self, recording: Recording) -> None:
        fitted = self.recordings_[recording.name]
        same = np.array_equal(fitted.times, recording.times) and np.array_equal(
            fitted.values, recording.values, equal_nan=True
        )
        if not same:
            raise ValueError(
                f"recording {recording.name!r} differs from the one of that name given to fit: "
                "expected the same times, visible values and hidden entries; fit again"
            )
