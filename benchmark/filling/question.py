"""What a model is asked, and what it answers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.datasets import Mask, Recording

__all__ = ["FilledEntries", "GapQuestion", "with_channels", "without_unseen"]


@dataclass(frozen=True, eq=False)
class GapQuestion:
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
class FilledEntries:
    """What a model puts at M wanted entries, in the order of ``np.nonzero(question.target)``.

    Parameters
    ----------
    mean : ndarray of shape (M,)
    variance : ndarray of shape (M,) or None
        None if the model has no predictive distribution.
    """

    mean: Array
    variance: Array | None


def without_unseen(question: GapQuestion) -> GapQuestion:
    """Return the question without channels of which nothing is visible, unless they are wanted."""
    recordings = (question.given, *question.train)
    seen = np.any([recording.visible.any(axis=0) for recording in recordings], axis=0)
    return with_channels(question, seen | question.target.any(axis=0))


def with_channels(question: GapQuestion, kept: NDArray[np.bool_]) -> GapQuestion:
    """Return the question without channels (D,) that are not kept."""
    names = [question.given.channels[channel] for channel in np.flatnonzero(kept)]
    given, *train = _select_channels((question.given, *question.train), names)
    return GapQuestion(given, question.target[:, kept], tuple(train))


def _select_channels(recordings: Sequence[Recording], names: Sequence[str]) -> list[Recording]:
    return [
        recording if len(names) == len(recording.channels) else recording.select(names)
        for recording in recordings
    ]
