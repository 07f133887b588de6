"""Windows around the gaps, for models that cannot take a whole recording.

A model that is made for some hundred frames (`FrameImputer.max_frames`) is fitted anew for each
window of a longer recording, and to the beginnings of the others.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mocapbench.benchmark.filling.gaps import gaps_of
from mocapbench.benchmark.filling.question import GapQuestion
from mocapbench.datasets import Recording

__all__ = ["Window", "windows_of"]

_LEAST_CONTEXT = 10
"""Frames on each side of a gap, as far as there are any."""


@dataclass(frozen=True)
class Window:
    """A part of a recording, and what of it is wanted.

    Parameters
    ----------
    first, stop : int
        Its frames [first, stop).
    wanted_first, wanted_stop : int
        The frames within it that hold its gaps; gaps beside them belong to other windows.
    """

    first: int
    stop: int
    wanted_first: int
    wanted_stop: int

    def of(self, question: GapQuestion, train: tuple[Recording, ...]) -> GapQuestion:
        """Return the question of filling this window's gaps."""
        whole = question.given
        given = whole.frames(np.arange(self.first, self.stop))
        target = question.target[self.first : self.stop].copy()
        rows = np.arange(self.first, self.stop)
        target[(rows < self.wanted_first) | (rows >= self.wanted_stop)] = False
        return GapQuestion(
            replace(given, name=f"{whole.name} [{self.first}:{self.stop}]"), target, train
        )


def windows_of(question: GapQuestion, max_frames: int | None) -> list[tuple[Window, GapQuestion]]:
    """Return the windows that a model fills one by one, and the question of each.

    Parameters
    ----------
    question : GapQuestion
    max_frames : int or None
        The most frames that the model takes, all recordings together; None means no limit.

    Raises
    ------
    ValueError
        If a gap is too long for any window.
    """
    n_frames = len(question.given.times)
    if max_frames is None or question.n_frames <= max_frames:
        return [(Window(0, n_frames, 0, n_frames), question)]
    train = tuple(_beginnings(question.train, max_frames // 2))
    room = max_frames - sum(len(recording.times) for recording in train)
    return [
        (window, window.of(question, train))
        for window in (_around(*group, room, n_frames) for group in _groups(question, room))
    ]


def _groups(question: GapQuestion, room: int) -> list[tuple[int, int]]:
    """Return frames [first, stop) of gaps that fit in one window of ``room`` frames together."""
    groups: list[tuple[int, int]] = []
    frames = np.asarray(question.target.any(axis=1))
    for gap in gaps_of(frames[:, np.newaxis]):
        if len(gap) + 2 * _LEAST_CONTEXT > room:
            raise ValueError(
                f"expected gaps of at most {max(room - 2 * _LEAST_CONTEXT, 0)} frames, got one of "
                f"{len(gap)}; choose a model that takes longer ones"
            )
        together = bool(groups) and gap.stop - groups[-1][0] + 2 * _LEAST_CONTEXT <= room
        groups.append((groups.pop()[0] if together else gap.start, gap.stop))
    return groups


def _around(first: int, stop: int, room: int, n_frames: int) -> Window:
    """Return a window of ``room`` frames, as even on both sides as the recording's ends allow."""
    before = (room - (stop - first)) // 2
    start = min(max(first - before, 0), max(n_frames - room, 0))
    return Window(start, min(start + room, n_frames), first, stop)


def _beginnings(recordings: Sequence[Recording], room: int) -> Iterator[Recording]:
    """Yield the first frames of each recording, about ``room`` in all."""
    share = room // max(len(recordings), 1)
    for recording in recordings:
        if share:
            yield recording.frames(np.arange(min(share, len(recording.times))))
