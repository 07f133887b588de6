"""Ways to hide entries of a recording: frames, entries, gaps, or the gaps of another file.

Each way is a function that draws from the generator that it is given alone. An entry that the file
itself lacks is never chosen, since no score could come of it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mocapbench.basics.mask_runs import free_starts
from mocapbench.benchmark.task_files.selection import Span, matching_channels
from mocapbench.datasets import Archive, Mask, Recording, frame_rate
from mocapbench.datasets.formats.sets import same_rate

__all__ = [
    "Hiding",
    "HidingError",
    "HidingPlace",
    "gap_length",
    "group_columns",
    "hide_entries",
    "hide_gaps",
    "hide_same_gaps",
    "hide_spans",
    "place_gaps",
]

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


Hiding = Callable[[Recording, HidingPlace], Mask]
"""Returns the entries (N, D) to hide; a `HidingError` says that a recording does not have them."""


def hide_spans(
    recording: Recording,
    place: HidingPlace,
    /,
    spans: Sequence[Span],
    channels: Sequence[str] = (),
) -> Mask:
    """Return stated frames of some channels, the same in every fold; see `Hiding`."""
    del place
    n_frames = len(recording.times)
    for start, stop in spans:
        if start >= n_frames or (stop is not None and stop > n_frames):
            raise HidingError(f"frames within its {n_frames}", f"{start}:{stop or ''}")
    hidden = np.zeros(recording.values.shape, dtype=bool)
    for start, stop in spans:
        hidden[start:stop, _columns_of(channels, recording)] = True
    return hidden & recording.visible


def hide_entries(
    recording: Recording, place: HidingPlace, /, share: float, channels: Sequence[str] = ()
) -> Mask:
    """Return a share of the visible entries of some channels, each drawn by itself."""
    eligible = np.zeros(recording.values.shape, dtype=bool)
    eligible[:, _columns_of(channels, recording)] = True
    entries = np.flatnonzero(eligible & recording.visible)
    chosen = place.rng.permutation(entries)[: round(share * len(entries))]
    hidden = np.zeros(recording.values.size, dtype=bool)
    hidden[chosen] = True
    return hidden.reshape(recording.values.shape)


def hide_gaps(
    recording: Recording,
    place: HidingPlace,
    /,
    seconds: float,
    count: int,
    group: Callable[[Recording], list[list[int]]],
) -> Mask:
    """Return gaps of one length at random places.

    A gap lies in a stretch that is visible, with a visible frame on either side, so that no two
    grow together.

    Parameters
    ----------
    recording, place
        See `Hiding`.
    seconds : float
        Their length, rounded to whole frames, of which it is one or more.
    count : int
        How many.
    group : callable
        Returns the groups of columns of which each gap hides one; see `group_columns`.
    """
    length, hidden = gap_length(seconds, recording), np.zeros(recording.values.shape, dtype=bool)
    for start, columns in place_gaps(recording, place.rng, group(recording), length, count):
        hidden[start : start + length, list(columns)] = True
    return hidden


def place_gaps(
    recording: Recording,
    rng: np.random.Generator,
    groups: Sequence[Sequence[int]],
    length: int,
    count: int,
) -> list[tuple[int, Sequence[int]]]:
    """Return gaps at random places, each by its first frame and its columns.

    Parameters
    ----------
    recording : Recording
    rng : numpy.random.Generator
    groups : sequence of sequence of int
        Columns, of which each gap hides those of one group.
    length : int
        Of each gap, in frames.
    count : int
        How many.

    Raises
    ------
    HidingError
        If there is no room for them.
    """
    free = recording.visible.copy()
    gaps: list[tuple[int, Sequence[int]]] = []
    for _ in range(count):
        blocked = (np.asarray(~free[:, list(group)].all(axis=1)) for group in groups)
        starts = [free_starts(frames, length) for frames in blocked]
        with_room = [index for index, found in enumerate(starts) if len(found)]
        if not with_room:
            raise HidingError(
                f"{count} visible stretches of {length / frame_rate(recording):.3g} s, {length} "
                "frames each, with a visible frame on either side",
                f"{len(recording.times)} frames without room for them",
            )
        drawn = int(rng.choice(with_room))
        start = int(rng.choice(starts[drawn]))
        free[start : start + length, list(groups[drawn])] = False
        gaps.append((start, groups[drawn]))
    return gaps


def gap_length(seconds: float, recording: Recording) -> int:
    """Return how many frames of a recording a gap has.

    Raises
    ------
    HidingError
        If it is shorter than one.
    """
    if len(recording.times) < 2:
        raise HidingError("two frames or more, which have a rate", f"{len(recording.times)}")
    rate = frame_rate(recording)
    if seconds * rate < 1.0 - _ROUNDING:
        raise HidingError(f"gaps of a frame or more, which is {1.0 / rate:.3g} s", f"{seconds:g} s")
    return max(1, round(seconds * rate))


def group_columns(
    recording: Recording, /, together: str = "all", channels: Sequence[str] = ()
) -> list[list[int]]:
    """Return the columns that are hidden together.

    Parameters
    ----------
    recording : Recording
    together : str
        ``"all"`` channels; those of one ``"joint"`` or marker, alike up to the last dot of their
        names; or one ``"channel"``.
    channels : sequence of str
    """
    columns = _columns_of(channels, recording)
    names = [recording.channels[column] for column in columns]
    match together:
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


def hide_same_gaps(
    recording: Recording, place: HidingPlace, /, uri: str, channels: Sequence[str] = ()
) -> Mask:
    """Return the gaps of another recording, by the names of channels.

    The first fold has them where that recording has them. In the others all move by the same time,
    and what leaves at the end comes in at the beginning.

    Parameters
    ----------
    recording, place
        See `Hiding`.
    uri : str
        Address of the other recording, of the same frame rate.
    channels : sequence of str
    """
    pattern = place.archive.recording(uri)
    if not same_rate(recording, pattern):
        expected = f"{frame_rate(recording):.6g} frames per second in {uri} too"
        raise HidingError(expected, f"{frame_rate(pattern):.6g}")
    gaps, n_frames = _copy_gaps(pattern, recording, channels), len(recording.times)
    drawn = place.rng.permutation(len(gaps)) if gaps.any() else ()
    for shift in (0, *drawn) if place.fold == 0 else drawn:
        hidden: Mask = np.roll(gaps, shift, axis=0)[:n_frames] & recording.visible
        if hidden.any():
            return hidden
    raise HidingError(f"gaps of its channels in {uri}", "none where it is visible")


def _copy_gaps(pattern: Recording, recording: Recording, channels: Sequence[str]) -> Mask:
    """Return the gaps (M, D) in the channels of ``recording``, M the longer of the two."""
    n_frames = max(len(pattern.times), len(recording.times))
    gaps = np.zeros((n_frames, len(recording.channels)), dtype=bool)
    for column in _columns_of(channels, recording):
        name = recording.channels[column]
        if name in pattern.channels:
            lacking = ~pattern.visible[:, pattern.channels.index(name)]
            gaps[: len(lacking), column] = lacking
    return gaps


def _columns_of(patterns: Sequence[str], recording: Recording) -> list[int]:
    """Return the columns of the channels that fit a pattern; refuse patterns that none fits."""
    names = matching_channels(patterns, recording.channels)
    if not names:
        wanted = ", ".join(map(repr, patterns))
        raise HidingError(f"channels that match {wanted}", f"{', '.join(recording.channels[:6])} …")
    return [recording.channels.index(name) for name in names]
