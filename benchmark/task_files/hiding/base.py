"""A way to hide entries of a recording.

Each way is a value with a method ``mask``, and draws from the generator that it is given alone. An
entry that the file itself lacks is never chosen, since no score could come of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from mocapbench.benchmark.task_files.selection import matching_channels
from mocapbench.datasets import Archive, Mask, Recording

__all__ = ["Hiding", "HidingError", "HidingPlace", "columns_of"]


class HidingError(ValueError):
    """A recording that does not have what is to be hidden of it.

    Parameters
    ----------
    expected, got : str
        What it should have, and what it has.
    """

    def __init__(self, expected: str, got: str) -> None:
        super().__init__(expected, got)
        self.expected = expected
        self.got = got

    def __str__(self) -> str:
        return f"expected {self.expected}, got {self.got}"


@dataclass(frozen=True)
class HidingPlace:
    """Where something is hidden.

    Parameters
    ----------
    fold : int
        Counted from 0.
    rng : numpy.random.Generator
        The fold's own.
    archive : Archive
        For the gaps of other recordings.
    """

    fold: int
    rng: np.random.Generator
    archive: Archive


class Hiding(Protocol):
    """A way to hide entries of a recording."""

    def mask(self, recording: Recording, place: HidingPlace, /) -> Mask:
        """Return the entries (N, D) to hide.

        Raises
        ------
        HidingError
            If the recording does not have what is to be hidden.
        """


def columns_of(patterns: Sequence[str], recording: Recording) -> list[int]:
    """Return the columns of the channels that fit a pattern; refuse patterns that none fits."""
    names = matching_channels(patterns, recording.channels)
    if not names:
        wanted = ", ".join(map(repr, patterns))
        raise HidingError(f"channels that match {wanted}", f"{', '.join(recording.channels[:6])} …")
    return [recording.channels.index(name) for name in names]
