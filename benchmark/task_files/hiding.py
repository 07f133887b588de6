"""What a task file hides: frames, channels, a share of the entries, gaps, or another file's gaps.

Each way is a value with a method ``mask``, and draws from the generator that it is given alone. An
entry that the file itself lacks is never chosen, since no score could come of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.task_files.selection import Span, matching_channels
from mocapbench.datasets import Archive, Mask, Recording, frame_rate
from mocapbench.datasets.formats.sets import same_rate

__all__ = ["Hiding", "HidingError", "Place", "RandomEntries", "RandomGaps", "SameGaps", "Spans"]

_ROUNDING = 0.05
"""Of a frame, as people write 1/30 s as 0.033 or 0.03333."""


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
class Place:
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

    def mask(self, recording: Recording, place: Place, /) -> Mask:
        """Return the entries (N, D) to hide.

        Raises
        ------
        HidingError
            If the recording does not have what is to be hidden.
        """


@dataclass(frozen=True)
class Spans:
    """Stated frames of some channels.

    Parameters
    ----------
    spans : tuple of Span
    channels : tuple of str
        Regular expressions; none stands for all channels.
    """

    spans: tuple[Span, ...]
    channels: tuple[str, ...] = ()

    def mask(self, recording: Recording, place: Place, /) -> Mask:
        """Return the same entries in every fold; see `Hiding`."""
        del place
        n_frames = len(recording.times)
        for span in self.spans:
            if not span.within(n_frames):
                raise HidingError(
                    f"frames within its {n_frames}", f"{span.start}:{span.stop or ''}"
                )
        hidden = np.zeros(recording.values.shape, dtype=bool)
        for span in self.spans:
            hidden[span.slice, _columns(self.channels, recording)] = True
        return hidden & recording.visible


@dataclass(frozen=True)
class RandomEntries:
    """A share of the visible entries of some channels, each drawn by itself.

    Parameters
    ----------
    share : float
        Between 0 and 1.
    channels : tuple of str
    """

    share: float
    channels: tuple[str, ...] = ()

    def mask(self, recording: Recording, place: Place, /) -> Mask:
        """Return a draw of the fold; see `Hiding`."""
        eligible = np.zeros(recording.values.shape, dtype=bool)
        eligible[:, _columns(self.channels, recording)] = True
        entries = np.flatnonzero(eligible & recording.visible)
        chosen = place.rng.permutation(entries)[: round(self.share * len(entries))]
        hidden = np.zeros(recording.values.size, dtype=bool)
        hidden[chosen] = True
        return hidden.reshape(recording.values.shape)


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

    def mask(self, recording: Recording, place: Place, /) -> Mask:
        """Return a draw of the fold; see `Hiding`."""
        groups, length = self._groups(recording), self.frames(recording)
        free = recording.visible.copy()
        starts = [_starts(free[:, group], length) for group in groups]
        for _ in range(self.count):
            with_room = [index for index, found in enumerate(starts) if len(found)]
            if not with_room:
                raise self._no_room(length, recording)
            drawn = int(place.rng.choice(with_room))
            start = int(place.rng.choice(starts[drawn]))
            free[start : start + length, groups[drawn]] = False
            starts[drawn] = _starts(free[:, groups[drawn]], length)
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
        columns = _columns(self.channels, recording)
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


@dataclass(frozen=True)
class SameGaps:
    """The gaps of another recording, by the names of channels.

    The first fold has them where that recording has them. In the others all move by the same time,
    and what leaves at the end comes in at the beginning.

    Parameters
    ----------
    uri : str
        Address of the other recording, of the same frame rate.
    channels : tuple of str
    """

    uri: str
    channels: tuple[str, ...] = ()

    def mask(self, recording: Recording, place: Place, /) -> Mask:
        """Return the gaps, moved by the draw of the fold; see `Hiding`."""
        pattern = place.archive.recording(self.uri)
        if not same_rate(recording, pattern):
            expected = f"{frame_rate(recording):.6g} frames per second in {self.uri} too"
            raise HidingError(expected, f"{frame_rate(pattern):.6g}")
        gaps, n_frames = self._gaps(pattern, recording), len(recording.times)
        drawn = place.rng.permutation(len(gaps)) if gaps.any() else ()
        for shift in (0, *drawn) if place.fold == 0 else drawn:
            hidden: Mask = np.roll(gaps, shift, axis=0)[:n_frames] & recording.visible
            if hidden.any():
                return hidden
        raise HidingError(f"gaps of its channels in {self.uri}", "none where it is visible")

    def _gaps(self, pattern: Recording, recording: Recording) -> Mask:
        """Return the gaps (M, D) in the channels of ``recording``, M the longer of the two."""
        n_frames = max(len(pattern.times), len(recording.times))
        gaps = np.zeros((n_frames, len(recording.channels)), dtype=bool)
        for column in _columns(self.channels, recording):
            name = recording.channels[column]
            if name in pattern.channels:
                lacking = ~pattern.visible[:, pattern.channels.index(name)]
                gaps[: len(lacking), column] = lacking
        return gaps


def _columns(patterns: Sequence[str], recording: Recording) -> list[int]:
    """Return the columns of the channels that fit a pattern; refuse patterns that none fits."""
    names = matching_channels(patterns, recording.channels)
    if not names:
        wanted = ", ".join(map(repr, patterns))
        raise HidingError(f"channels that match {wanted}", f"{', '.join(recording.channels[:6])} …")
    return [recording.channels.index(name) for name in names]


def _starts(free: Mask, length: int) -> NDArray[np.intp]:
    """Return where ``length`` whole frames in a row are free (N, K), and one on either side."""
    width = length + 2
    blocked = np.concatenate([[0], np.cumsum(~free.all(axis=1))])
    return np.flatnonzero(blocked[width:] == blocked[:-width]) + 1
