"""The best-matching windows of training motion, stretched in time and averaged.

Motions of one kind repeat: the motion in a gap occurs in training too, a little faster or slower.
Every window of every training recording is therefore compared, at several speeds, with the visible
frames beside the gap, and the best-matching windows fill it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_channels, check_recordings
from mocapbench.baselines.common.pose_units import from_pose_units, in_pose_units
from mocapbench.baselines.common.recordings import by_content, hidden_frames, stretches
from mocapbench.baselines.common.validation import check_count
from mocapbench.baselines.protocols import FrameImputer, Inductive, Prediction
from mocapbench.basics.arrays import Array, Index
from mocapbench.basics.mask_runs import runs
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["AlignedWindow"]


_SCALES = np.arange(75, 136, 5) / 100
"""Training frames per frame at which windows are read."""
_N_CONTEXT = 3
"""Frames on each side of a gap that are compared."""

_Tempo = tuple[FrameByChannel, Array]
"""A stretch of complete frames (n, D), and where a window's frames (L,) lie after its first one."""


class AlignedWindow(FrameImputer, Inductive):
    r"""Fill a gap with the mean of the training windows that match the frames beside it.

    A window spans the gap and up to three frames on each side. Windows start at every training
    frame, are read at 0.75, 0.80 … 1.35 training frames per frame, and are interpolated linearly.
    The error of a window is the sum of squared differences at the visible frames beside the gap;
    where the gap touches an end of the recording, these lie on one side only. The fill is the
    unweighted mean of the best windows, neither shifted nor scaled. Gaps are filled independently.
    Time is counted in frames, so that all recordings should have the same frame rate. Where
    channels have several units, degrees and radians count as degrees, and mm, cm and m as the CMU
    database's unit of length, 5.64 cm. There is no predictive distribution.

    Parameters
    ----------
    n_windows : int, default=5
        Number of best windows that are averaged.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    runs_ : list of ndarray (n, D)
        The stretches of frames without hidden entries, in the units in which errors are measured.

    Notes
    -----
    With V the visible frames of the window, counted from its start, and Y(u) the training frames,
    interpolated at u, a window that starts at frame s and is read at speed r has the error

    .. math:: e(s, r) = \sum_{i \in V} \| y_i - Y(s + r i) \|^2

    and the fill of frame i is the mean of :math:`Y(s + r i)` over the ``n_windows`` of least error.

    References
    ----------
    Not from a publication. The task for which it was written is that of J. M. Wang, D. J. Fleet and
    A. Hertzmann (2008), Gaussian Process Dynamical Models for Human Motion, IEEE TPAMI 30(2),
    Table 2.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import AlignedWindow
    >>> from mocapbench.datasets import Recording
    >>> times = np.arange(40) / 10
    >>> knee = np.sin(2 * np.pi * times)[:, None]
    >>> walk = Recording("walk", times, knee, ("knee",), ("deg",))
    >>> gap = (np.arange(40) >= 15) & (np.arange(40) < 20)
    >>> model = AlignedWindow(n_windows=2).fit([walk])
    >>> (prediction,) = model.impute([walk.hide(gap[:, None])])
    >>> bool(np.allclose(prediction.mean, knee))
    True
    """

    family: ClassVar[str] = "Alignment"
    provides: ClassVar[frozenset[str]] = (
        FrameImputer.provides | Inductive.provides | {"scales along"}
    )

    max_frames: ClassVar[int | None] = 8000

    def __init__(self, n_windows: int = 5) -> None:
        self.n_windows = n_windows

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Keep the complete stretches of the recordings.

        Raises
        ------
        ValueError
            If ``n_windows`` is not an integer of at least 1, there is no recording, channels
            differ, or a name repeats.
        """
        check_count("n_windows", self.n_windows, 1)
        checked = by_content(check_recordings(recordings))
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        self.runs_: list[FrameByChannel] = [
            stretch for recording in map(in_pose_units, checked) for stretch in stretches(recording)
        ]
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the mean of the best windows in each gap.

        Raises
        ------
        ValueError
            If channels differ, a frame is hidden in part, no frame beside a gap is visible, or no
            complete stretch of training is long enough.
        """
        check_is_fitted(self)
        check_channels(recordings, self.channels_, self.units_)
        return [
            from_pose_units(recording, self._fill_recording(in_pose_units(recording)))
            for recording in recordings
        ]

    def _fill_recording(self, recording: Recording) -> FrameByChannel:
        hidden = hidden_frames(recording)
        filled = recording.values.copy()
        for gap in runs(hidden):
            first, last = gap[0] - _N_CONTEXT, gap[-1] + _N_CONTEXT
            window = np.arange(max(first, 0), min(last + 1, len(hidden)))
            beside = ~hidden[window]
            if not beside.any():
                raise ValueError(
                    f"recording {recording.name!r}: expected a visible frame beside frames "
                    f"{gap[0]} to {gap[-1]}, got none"
                )
            filled[gap] = self._best(beside, recording.values[window[beside]])[gap - window[0]]
        return filled

    def _best(self, beside: NDArray[np.bool_], values: FrameByChannel) -> FrameByChannel:
        """Return the mean (L, D) of the windows nearest to ``values`` at frames ``beside`` (L,)."""
        tempi = self._tempi(len(beside))
        context = np.flatnonzero(beside)
        starts = [_window_starts(tempo) for tempo in tempi]
        errors = [
            ((_read_windows(tempo, first, context) - values) ** 2).sum(axis=(1, 2))
            for tempo, first in zip(tempi, starts, strict=True)
        ]
        owners = np.repeat(np.arange(len(tempi)), [len(first) for first in starts])
        best = np.argsort(np.concatenate(errors), kind="stable")[: self.n_windows]
        rows, firsts = np.arange(len(beside)), np.concatenate(starts)
        windows = [_read_windows(tempi[owners[i]], firsts[[i]], rows)[0] for i in best]
        return np.asarray(np.mean(windows, axis=0))

    def _tempi(self, length: int) -> list[_Tempo]:
        """Return each stretch at each speed at which it contains a window of ``length`` frames."""
        # Rounded so that 0.8 · 5 is exactly frame 4.
        offsets = np.round(np.outer(_SCALES, np.arange(length)), 9)
        tempi = [(run, row) for row in offsets for run in self.runs_]
        long_enough = [tempo for tempo in tempi if len(_window_starts(tempo))]
        if not long_enough:
            longest = max((len(run) for run in self.runs_), default=0)
            raise ValueError(
                f"expected a complete training stretch of {int(np.ceil(offsets[0, -1])) + 1} "
                f"frames for a window of {length}, got {longest} at most; train on longer ones"
            )
        return long_enough


def _window_starts(tempo: _Tempo) -> Index:
    """Return the first frames (A,) of all windows within a stretch; there may be none."""
    run, offsets = tempo
    return np.arange(len(run) - int(np.ceil(offsets[-1])))


def _read_windows(tempo: _Tempo, starts: Index, rows: Index) -> Array:
    """Return ``rows`` (k,) of the windows from ``starts`` (A,), interpolated: (A, k, D)."""
    run, offsets = tempo
    # On the line between the frames before and after each place.
    places = starts[:, None] + offsets[rows]
    before, after = np.floor(places).astype(np.intp), np.ceil(places).astype(np.intp)
    weight = (places - before)[:, :, None]
    return np.asarray((1 - weight) * run[before] + weight * run[after])
