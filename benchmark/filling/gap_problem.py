"""What a model is to fill, what it predicts there, and the parts that a long recording is cut into.

A model that is made for some hundred frames (`FrameImputer.max_frames`) is fitted anew for each
window around the gaps of a longer recording, and to the beginnings of the others.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.benchmark.filling.gaps import find_gaps, mask_ends
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.problems.unit import Unit
from mocapbench.datasets import Mask, Recording

__all__ = [
    "GapProblem",
    "PredictedEntries",
    "cut_blank_ends",
    "cut_windows",
    "drop_unseen",
    "place_windows",
    "pose_imputing",
    "select_channels",
]

_FEWEST_SEEN = 2
"""Visible entries of a channel from which models learn."""
_LEAST_CONTEXT = 10
"""Frames on each side of a gap, as far as there are any."""


@dataclass(frozen=True, eq=False)
class GapProblem:
    """A recording to fill, and what to learn from.

    Parameters
    ----------
    given : Recording
        N frames of D channels; models learn from its visible entries too.
    target : ndarray of bool of shape (N, D)
        The hidden entries that are wanted.
    train : tuple of Recording
        Other recordings of the same channels.
    """

    given: Recording
    target: Mask
    train: tuple[Recording, ...] = ()

    @property
    def n_frames(self) -> int:
        """The number of frames of all recordings together."""
        return sum(len(recording.times) for recording in (self.given, *self.train))


@dataclass(frozen=True, eq=False)
class PredictedEntries:
    """What a model predicts of M wanted entries, in the order of ``np.nonzero(problem.target)``.

    Parameters
    ----------
    mean : ndarray of shape (M,)
    variance : ndarray of shape (M,) or None
        None if the model has no predictive distribution.
    """

    mean: Array
    variance: Array | None


def pose_imputing(problem: GapProblem) -> ImputeProblem:
    """Return the problem as one that models are fitted to and asked, as in a run."""
    return ImputeProblem(
        train=(*problem.train, problem.given),
        given=(problem.given,),
        truth=(problem.given.values,),  # nobody scores here, and nobody knows it
        unit=Unit.natural(len(problem.given.channels)),
    )


def drop_unseen(problem: GapProblem) -> GapProblem:
    """Return the problem without channels of which little is visible, unless they are wanted.

    A marker that is seen once, as those that are attached for calibration alone, tells a model
    nothing of how far it goes.
    """
    recordings = (problem.given, *problem.train)
    counts = np.sum([recording.visible.sum(axis=0) for recording in recordings], axis=0)
    seen = counts >= _FEWEST_SEEN
    return select_channels(problem, seen | problem.target.any(axis=0))


def select_channels(problem: GapProblem, kept: Mask) -> GapProblem:
    """Return the problem without channels (D,) that are not kept."""
    if kept.all():
        return problem
    names = [problem.given.channels[channel] for channel in np.flatnonzero(kept)]
    given, *train = (
        recording if len(names) == len(recording.channels) else recording.select(names)
        for recording in (problem.given, *problem.train)
    )
    return GapProblem(given, problem.target[:, kept], tuple(train))


def cut_blank_ends(problem: GapProblem) -> GapProblem:
    """Return the problem without frames at its ends in which nothing is visible or wanted."""
    needed = np.asarray(problem.given.visible.any(axis=1) | problem.target.any(axis=1))
    kept = ~mask_ends(needed[:, np.newaxis])[:, 0]
    if kept.all():
        return problem
    return GapProblem(problem.given.frames(kept), problem.target[kept], problem.train)


def cut_windows(problem: GapProblem, max_frames: int | None) -> list[tuple[slice, GapProblem]]:
    """Return the windows that a model fills one by one: their frames, and the problem of each.

    Of the gaps in a window, its problem wants those around which it was cut; those beside them
    belong to other windows.

    Parameters
    ----------
    problem : GapProblem
    max_frames : int or None
        The most frames that the model takes, all recordings together; None means no limit.

    Raises
    ------
    ValueError
        If a gap is too long for any window.
    """
    if max_frames is None or problem.n_frames <= max_frames:
        return [(slice(0, len(problem.given.times)), problem)]
    lengths = _share_frames(problem.train, max_frames // 2)
    train = tuple(
        recording.frames(np.arange(length))
        for recording, length in zip(problem.train, lengths, strict=True)
        if length
    )
    return [
        (frames, _cut_window(problem, frames, wanted, train))
        for frames, wanted in place_windows(problem, max_frames)
    ]


def place_windows(problem: GapProblem, max_frames: int | None) -> list[tuple[slice, slice]]:
    """Return the frames of each window of `cut_windows`, and those between which it wants gaps."""
    n_frames = len(problem.given.times)
    if max_frames is None or problem.n_frames <= max_frames:
        return [(slice(0, n_frames),) * 2]
    room = max_frames - sum(_share_frames(problem.train, max_frames // 2))
    return [
        (_centre_window(first, stop, room, n_frames), slice(first, stop))
        for first, stop in _group_gaps_by_window(problem, room)
    ]


def _cut_window(
    problem: GapProblem, frames: slice, wanted: slice, train: tuple[Recording, ...]
) -> GapProblem:
    """Return the problem of filling the gaps at the wanted frames from those of a window."""
    given = problem.given.frames(np.arange(frames.start, frames.stop))
    target = np.zeros_like(problem.target)
    target[wanted] = problem.target[wanted]
    name = f"{problem.given.name} [{frames.start}:{frames.stop}]"
    return GapProblem(replace(given, name=name), target[frames], train)


def _group_gaps_by_window(problem: GapProblem, room: int) -> list[tuple[int, int]]:
    """Return frames [first, stop) of gaps that fit in one window of ``room`` frames together."""
    groups: list[tuple[int, int]] = []
    frames = np.asarray(problem.target.any(axis=1))
    for gap in find_gaps(frames[:, np.newaxis]):
        if len(gap) + 2 * _LEAST_CONTEXT > room:
            raise ValueError(
                f"expected gaps of at most {max(room - 2 * _LEAST_CONTEXT, 0)} frames, got one of "
                f"{len(gap)}; choose a model that takes longer ones"
            )
        together = bool(groups) and gap.stop - groups[-1][0] + 2 * _LEAST_CONTEXT <= room
        groups.append((groups.pop()[0] if together else gap.start, gap.stop))
    return groups


def _centre_window(first: int, stop: int, room: int, n_frames: int) -> slice:
    """Return a window of ``room`` frames, as even on both sides as the recording's ends allow."""
    before = (room - (stop - first)) // 2
    start = min(max(first - before, 0), max(n_frames - room, 0))
    return slice(start, min(start + room, n_frames))


def _share_frames(recordings: Sequence[Recording], room: int) -> list[int]:
    """Return how many first frames of each recording are taken, about ``room`` in all."""
    share = room // max(len(recordings), 1)
    return [min(share, len(recording.times)) for recording in recordings]
