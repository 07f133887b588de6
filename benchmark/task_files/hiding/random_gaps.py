"""Gaps of one length at random places."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.basics.gaps import free_starts
from mocapbench.benchmark.task_files.hiding.base import HidingError, HidingPlace, columns_of
from mocapbench.datasets import Mask, Recording, frame_rate

__all__ = ["RandomGaps"]

_ROUNDING = 0.05
"""Of a frame, as people write 1/30 s as 0.033 or 0.03333."""


@dataclass(frozen=True)
class RandomGaps:
    """Gaps of one length at random places.

    A gap lies in a stretch that is visible, with a visible frame on either side, so that no two
    grow together.

    Parameters
    ----------
    seconds : float
        Their length, rounded to whole frames, of which it is one or more.
    count : int
        How many.
    together : str
        What a gap hides: ``"all"`` channels; those of one ``"joint"`` or marker, alike up to the
        last dot of their names; or one ``"channel"``. Which one is drawn for every gap.
    channels : tuple of str
    """

    seconds: float
    count: int
    together: str = "all"
    channels: tuple[str, ...] = ()

    def mask(self, recording: Recording, place: HidingPlace, /) -> Mask:
        """Return a draw of the fold; see `Hiding`."""
        groups, length = self._groups(recording), self.frames(recording)
        free = recording.visible.copy()
        starts = [free_starts(np.asarray(~free[:, group].all(axis=1)), length) for group in groups]
        for _ in range(self.count):
            with_room = [index for index, found in enumerate(starts) if len(found)]
            if not with_room:
                raise self._no_room(length, recording)
            drawn = int(place.rng.choice(with_room))
            start = int(place.rng.choice(starts[drawn]))
            free[start : start + length, groups[drawn]] = False
            starts[drawn] = free_starts(np.asarray(~free[:, groups[drawn]].all(axis=1)), length)
        return recording.visible & ~free

    def frames(self, recording: Recording) -> int:
        """Return how many frames of a recording a gap has.

        Raises
        ------
        HidingError
            If a gap is shorter than one.
        """
        rate = frame_rate(recording)
        if self.seconds * rate < 1.0 - _ROUNDING:
            raise HidingError(
                f"gaps of a frame or more, which is {1.0 / rate:.3g} s", f"{self.seconds:g} s"
            )
        return max(1, round(self.seconds * rate))

    def _no_room(self, length: int, recording: Recording) -> HidingError:
        return HidingError(
            f"{self.count} visible stretches of {self.seconds:g} s, {length} frames each, "
            "with a visible frame on either side",
            f"{len(recording.times)} frames without room for them",
        )

    def _groups(self, recording: Recording) -> list[list[int]]:
        """Return the columns that are hidden together."""
        columns = columns_of(self.channels, recording)
        names = [recording.channels[column] for column in columns]
        match self.together:
            case "joint":
                owners = [name.rpartition(".")[0] or name for name in names]
            case "channel":
                owners = names
            case _:
                owners = ["all"] * len(names)
        return [
            [column for column, own in zip(columns, owners, strict=True) if own == owner]
            for owner in dict.fromkeys(owners)
        ]
