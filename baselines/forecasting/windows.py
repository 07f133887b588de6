"""Windows of recordings: a few frames that are seen, and the next ones, which are asked for."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Sequence
from typing import ClassVar, Self

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from mocapbench.baselines.common.checks import check_given, check_recordings
from mocapbench.baselines.common.recordings import by_content, hidden_frames, stretches
from mocapbench.baselines.common.validation import check_count
from mocapbench.baselines.protocols import Forecaster, Inductive, Prediction
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Recording

__all__ = [
    "WindowByFrameByChannel",
    "WindowForecaster",
    "count_ahead",
    "cut_windows",
    "describe_windows",
    "follow_last_frame",
    "leave_last_frame",
]

WindowByFrameByChannel = NDArray[np.float64]
"""(W, N, D) W windows of N frames."""


def cut_windows(recordings: Iterable[Recording], length: int) -> WindowByFrameByChannel:
    """Return every run of ``length`` frames of recordings that is visible in all channels.

    Raises
    ------
    ValueError
        If there is none.
    """
    runs = [run for recording in recordings for run in stretches(recording) if len(run) >= length]
    if not runs:
        raise ValueError(
            f"expected {length} frames in a row of some recording that are visible in all "
            "channels, got none; add such a recording, or ask for fewer frames with n_ahead"
        )
    windows = [sliding_window_view(run, length, axis=0).transpose(0, 2, 1) for run in runs]
    return np.concatenate(windows)


def count_ahead(recording: Recording) -> int:
    """Return how many frames are hidden after the last visible one.

    Raises
    ------
    ValueError
        If a frame is hidden in part, or others than the last ones are hidden.
    """
    hidden = hidden_frames(recording)
    if hidden.all() or (np.diff(hidden.astype(int)) < 0).any():
        raise ValueError(
            f"recording {recording.name!r}: expected visible frames and then hidden ones, got "
            "others; use a model that fills any gaps"
        )
    return int(hidden.sum())


def describe_windows(seen: WindowByFrameByChannel) -> Array:
    """Return the last frame, and how far the others are from it: (W, n_seen D)."""
    last = seen[:, -1]
    apart = seen[:, :-1] - last[:, None]
    return np.concatenate([last, apart.reshape(len(seen), -1)], axis=1)


def leave_last_frame(seen: WindowByFrameByChannel, ahead: WindowByFrameByChannel) -> Array:
    """Return how far the next frames are from the last one seen: (W, n_ahead D)."""
    return np.asarray((ahead - seen[:, -1:]).reshape(len(ahead), -1))


def follow_last_frame(seen: WindowByFrameByChannel, apart: Array) -> WindowByFrameByChannel:
    """Return the next frames (W, n_ahead, D) that `leave_last_frame` made ``apart`` of."""
    windows, _, n_channels = seen.shape
    return np.asarray(seen[:, -1:] + apart.reshape(windows, -1, n_channels))


class WindowForecaster(Forecaster, Inductive):
    """A model that learns the next frames from the last few, of all windows of recordings.

    A subclass defines `_learn` and `_predict`, and has the parameters ``n_seen`` and ``n_ahead``.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    """

    family: ClassVar[str] = "Forecasts"

    n_seen: int
    n_ahead: int

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Learn from every window of the recordings.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, a name repeats,
            or no recording is as long as a window.
        """
        check_count("n_seen", self.n_seen, 2)
        check_count("n_ahead", self.n_ahead, 1)
        self._check_parameters()
        checked = check_recordings(recordings)
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        windows = cut_windows(self._prepare(by_content(checked)), self.n_seen + self.n_ahead)
        self._learn(windows[:, : self.n_seen], windows[:, self.n_seen :])
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the frames that follow the last visible one of each recording.

        Raises
        ------
        ValueError
            If channels differ, too few frames are visible or too many hidden, or others than the
            last ones are.
        """
        check_given(self, recordings)
        if not len(recordings):
            return []
        seen = np.stack([self._take_last(recording) for recording in recordings])
        return [
            _continue_recording(recording, ahead)
            for recording, ahead in zip(recordings, self._predict(seen), strict=True)
        ]

    def _take_last(self, recording: Recording) -> FrameByChannel:
        """Return the last visible frames (n_seen, D)."""
        n_ahead = count_ahead(recording)
        n_visible = len(recording.times) - n_ahead
        if n_visible < self.n_seen or n_ahead > self.n_ahead:
            raise ValueError(
                f"recording {recording.name!r}: expected {self.n_seen} visible frames or more and "
                f"up to {self.n_ahead} hidden ones, got {n_visible} and {n_ahead}; set n_seen and "
                "n_ahead"
            )
        return recording.values[n_visible - self.n_seen : n_visible]

    def _check_parameters(self) -> None:
        """Raise ValueError if a parameter of the subclass is out of range."""

    def _prepare(self, recordings: Sequence[Recording]) -> Sequence[Recording]:
        """Return the recordings of which windows are learnt from."""
        return recordings

    @abstractmethod
    def _learn(self, seen: WindowByFrameByChannel, ahead: WindowByFrameByChannel) -> None:
        """Learn from the windows (W, n_seen, D) and what follows them, (W, n_ahead, D)."""

    @abstractmethod
    def _predict(self, seen: WindowByFrameByChannel) -> WindowByFrameByChannel:
        """Return what follows (W, n_ahead, D)."""


def _continue_recording(recording: Recording, ahead: FrameByChannel) -> Prediction:
    mean = np.zeros_like(recording.values)
    n_ahead = count_ahead(recording)
    mean[len(mean) - n_ahead :] = ahead[:n_ahead]
    return Prediction.around(recording, mean)
