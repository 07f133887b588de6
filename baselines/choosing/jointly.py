"""Gaussian processes over the recordings to fill and those to learn from, as candidates."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from typing import Self

from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.calibration.ways import calibrate
from mocapbench.baselines.common.checks import check_given, pool
from mocapbench.baselines.gp.estimator import GaussianProcess
from mocapbench.baselines.protocols import Imputer, Inductive, Prediction
from mocapbench.datasets import Recording

__all__ = ["Jointly"]

_MOST_ENTRIES = 1.8e11
"""Σ (N D)³ over the recordings: of exact inference if each has gaps of its own."""
_MOST_FRAMES = 3e6
"""Σ N³: four walks of 90 frames, or one recording of 114. One of 200 takes half a minute."""


class Jointly(Imputer, Inductive):
    """A Gaussian process that fills recordings together with those that it has learnt from.

    It is worth its time where the recordings to fill are among them, so that what is visible there
    counts. Its parameters are those of `fit`. Whatever it is given afterwards, it goes on from them
    by one iteration of its search: that costs little, and parameters, of which there are few
    beside entries, tell little of what is held out (as in leave-one-out cross-validation with
    the parameters kept; C. E. Rasmussen and C. K. I. Williams (2006), Gaussian Processes for
    Machine Learning, §5.4.2).

    Parameters
    ----------
    process : GaussianProcess

    Attributes
    ----------
    recordings_ : tuple of Recording
        Those with which recordings are filled.
    process_ : GaussianProcess
        Fitted to those given to `fit`.
    """

    def __init__(self, process: GaussianProcess) -> None:
        self.process = process

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Learn the parameters and keep the recordings.

        Raises
        ------
        ValueError
            If the recordings are all complete; if they, and another one as large, are too large or
            too long; or if the process cannot learn from them.
        """
        self._keep(recordings)
        self.process_: GaussianProcess = copy(self.process).fit(_some_incomplete(recordings))
        return self

    def with_recordings(self, recordings: Sequence[Recording]) -> Self:
        """Return the model with its parameters, and with other recordings to fill beside.

        Raises
        ------
        ValueError
            If they, and another one as large, are too large or too long.
        """
        check_is_fitted(self)
        other = copy(self)
        other._keep(recordings)
        return other

    def _keep(self, recordings: Sequence[Recording]) -> None:
        largest = max(recordings, key=lambda recording: recording.values.size)
        _check_work([*recordings, largest])
        self.recordings_: tuple[Recording, ...] = tuple(recordings)
        self.channels_: tuple[str, ...] = largest.channels
        self.units_: tuple[str, ...] = largest.units

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return what the process predicts of each recording beside its own, calibrated.

        Raises
        ------
        ValueError
            If a recording is too large beside those, or its channels differ.
        """
        check_given(self, recordings)
        return [
            calibrate(self._learn_with(recording), self.recordings_, [recording])[0]
            for recording in recordings
        ]

    def impute_uncalibrated(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the predictions of `impute` with the variances of the exact posterior."""
        check_given(self, recordings)
        return [self._learn_with(recording).impute([recording])[0] for recording in recordings]

    def _learn_with(self, recording: Recording) -> GaussianProcess:
        # It comes first: of several with as many hidden entries, others are registered to it.
        others = [other for other in self.recordings_ if other.name != recording.name]
        together = pool([recording], others)
        _check_work(together)
        onwards: GaussianProcess = copy(self.process_).set_params(warm_start=True, max_iter=1)
        return onwards.fit(together)


def _some_incomplete(recordings: Sequence[Recording]) -> Sequence[Recording]:
    if all(recording.visible.all() for recording in recordings):
        raise ValueError(
            "expected a recording with hidden entries among those to learn from, got complete ones "
            "only: give those that are to be filled, too"
        )
    return recordings


def _check_work(recordings: Sequence[Recording]) -> None:
    entries = sum(float(recording.values.size) ** 3 for recording in recordings)
    frames = sum(float(len(recording.times)) ** 3 for recording in recordings)
    if entries > _MOST_ENTRIES or frames > _MOST_FRAMES:
        raise ValueError(
            "expected recordings whose numbers of entries (frames times channels), cubed, add up "
            f"to at most {_MOST_ENTRIES:.2g}, and of frames to {_MOST_FRAMES:.2g}, got "
            f"{entries:.2g} and {frames:.2g}: exact inference would take too long"
        )
