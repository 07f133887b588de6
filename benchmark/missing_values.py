"""Missing values that a file writes as numbers: zeros, a number such as 9999999, held values.

Some programs write 0, 0, 0 where a marker was not seen, some a number that nothing measures, some
the last position again. Motion tells such values by rules that real motion does not meet; where a
rule cannot tell, values stay, and the user may say what marks missing ones.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial, reduce
from math import isfinite, nan

import numpy as np

from mocapbench.baselines.common.markers import markers_of, points_of
from mocapbench.basics.arrays import Array, Index
from mocapbench.basics.mask_runs import run_bounds
from mocapbench.basics.words import format_count, join_names
from mocapbench.benchmark.errors import UsageError
from mocapbench.datasets import Mask, Recording

__all__ = [
    "MissingRule",
    "Told",
    "choose_missing_rule",
    "find_held",
    "find_zeros",
    "tell_missing",
    "undecided_values",
]

_NAMED = 4
"""Markers that a sentence names at most."""
_READ_AS_MISSING = "this is read as missing (fill --missing none keeps it)."
_FAR, _LONG = 3.0, 0.95
"""How many times as far as a long step, which is that quantile of its steps, a marker is from the
origin beside zeros."""
_ABOVE_NINES, _ABOVE_ALL, _REPEATED, _FEWEST_NINES = 2.0, 1000.0, 3, 3
"""How many times as large as all others a number of nines is, or one that occurs so often."""
_LEAST_HELD, _LEAP, _LEAST_STEP = 5, 2.0, 1 / 3
"""Frames that a value is held, at least; how many times as long as those around it the step is that
ends it, and as long as usual the step beside one that is held at an end."""
_COARSE, _MOSTLY = 0.05, 0.5
"""Share of coordinates that repeat by themselves in files of so few digits that all may; share of
frames in which others move."""
_BLOCK = 1024
"""Frames that are looked at together, so that long recordings take no more memory."""


Told = tuple[Mask, tuple[str, ...]]
"""Entries (N, D) whose values stand for missing ones, and sentences that say which and why."""
MissingRule = Callable[[Recording], Told]
"""What tells missing values of a recording whose angles are as the file has them."""


def choose_missing_rule(text: str | None) -> MissingRule:
    """Return the rule for what the user says marks missing values.

    Parameters
    ----------
    text : str or None
        ``zeros``, ``held``, ``none`` or a number; None leaves it to motion (``tell_missing``).

    Raises
    ------
    UsageError
        If it is something else.
    """
    if text is None:
        return tell_missing
    if text in _MARKS:
        return partial(_tell_marked, _MARKS[text])
    try:
        number = float(text)
    except ValueError:
        number = nan
    if not isfinite(number):
        raise UsageError(
            f"--missing: expected zeros, held, none or a number such as 9999999, got {text!r}"
        )
    return partial(_tell_marked, partial(_equal_values, number))


def tell_missing(recording: Recording) -> Told:
    """Return which values stand for missing ones by rules that real motion does not meet.

    Parameters
    ----------
    recording : Recording
        With angles as the file has them.
    """
    mask = _nothing(recording)
    remarks: list[str] = []
    for rule in (_tell_zeros, _tell_number, _tell_held):
        told, texts = rule(recording.hide(mask))
        mask |= told
        remarks += texts
    return mask, tuple(filter(None, [*remarks, undecided_values(recording.hide(mask))]))


def _tell_marked(mark: Callable[[Recording], Mask], recording: Recording) -> Told:
    mask = mark(recording)
    entries = format_count(int(mask.sum()), "entry counts", "entries count")
    return mask, (f"{entries} as missing, as --missing says.",) if mask.any() else ()


def undecided_values(recording: Recording) -> str:
    """Return which values may stand for missing ones where no rule tells it."""
    zeros = {name: int(rows.sum()) for name, rows in find_zeros(recording).items()}
    held: dict[str, int] = {}
    for name, start, stop, _ in find_held(recording):
        held[name] = max(held.get(name, 0), stop - start)
    sentences = (
        _count_frames(
            zeros, f"exactly {_zeros_of(recording)} in {{}} and elsewhere in others", "zeros"
        ),
        _count_frames(held, "exactly where the frame before has it for {}", "held"),
    )
    return " ".join(filter(None, sentences))


def _count_frames(frames: Mapping[str, int], where: str, mark: str) -> str:
    """Return a sentence on the markers that are somewhere in some frames, if there are any."""
    if not frames:
        return ""
    are = "is" if len(frames) == 1 else "are"
    return (
        f"{join_names([*frames], _NAMED)} {are} {where.format(_most_frames(frames))}: if that "
        f"marks missing values, fill --missing {mark} fills them."
    )


def _most_frames(frames: Mapping[str, int]) -> str:
    """Return the most frames of a marker, in words that hold for all of them."""
    return "up to " * (len(frames) > 1) + format_count(max(frames.values()), "frame")


def _tell_zeros(recording: Recording) -> Told:
    """Tell zeros by their distance from where the marker is before and after them.

    If they stand for missing values of one marker, they do so for all of the file.
    """
    markers = points_of(recording.channels, recording.units)
    rows = find_zeros(recording)
    far = {
        name: int(at.sum())
        for name, at in rows.items()
        if _is_far(recording.values[:, list(markers[name])], at)
    }
    mask = _nothing(recording)
    if not far:
        return mask, ()
    for places in map(list, markers.values()):
        mask[:, places] = (recording.values[:, places] == 0.0).all(axis=1)[:, None]
    are, it_is = ("is", "it is") if len(far) == 1 else ("are", "they are")
    where = f"exactly {_zeros_of(recording)} in {_most_frames(far)}"
    return (
        mask,
        (
            f"{join_names([*far], _NAMED)} {are} {where}, far from where {it_is} before and "
            f"after: {_READ_AS_MISSING}",
        ),
    )


def _zeros_of(recording: Recording) -> str:
    """Return the origin as a sentence names it, in space or, of video, in a plane."""
    axes = map(len, points_of(recording.channels, recording.units).values())
    return ", ".join("0" * max(axes, default=3))


def find_zeros(recording: Recording) -> dict[str, Mask]:
    """Return the frames (N,) in which each marker that is elsewhere in others is at the origin."""
    found, zero = {}, recording.values == 0.0
    for name, places in points_of(recording.channels, recording.units).items():
        rows = _in_all(zero, places)
        if rows.any() and (np.nan_to_num(recording.values[:, list(places)]) != 0.0).any():
            found[name] = rows
    return found


def _in_all(mask: Mask, places: Sequence[int]) -> Mask:
    """Return where a mask (N, D) is True in all of some channels (N,)."""
    # Not all() along the last axis, which takes ten times as long where that is short.
    return np.asarray(reduce(np.logical_and, (mask[:, place] for place in places)))


def _is_far(values: Array, zero: Mask) -> bool:
    """Return whether a point is so far from the origin beside all zeros that none is real.

    Far is three times the distance of a long step of its own, for each frame to the zeros.
    """
    (seen,) = np.nonzero(np.isfinite(values).all(axis=1) & ~zero)
    steps = np.linalg.norm(np.diff(values[seen], axis=0), axis=1)[np.diff(seen) == 1]
    if not len(steps):
        return False
    longest = np.quantile(steps, _LONG)
    for start, stop in run_bounds(zero).tolist():
        before, after = seen[seen < start][-1:], seen[seen >= stop][:1]
        beside = np.concatenate([before, after])
        apart = np.concatenate([start - before, after - stop + 1])
        if (np.linalg.norm(values[beside], axis=1) <= _FAR * longest * apart).any():
            return False
    return True


def _tell_number(recording: Recording) -> Told:
    """Tell a number that nothing measures: of nines alone, or far beyond all of its channel."""
    values = recording.values
    largest, count, rest = _measure_sizes(values)
    nines = np.array([_is_nines(size) for size in largest], dtype=bool)
    often = count >= _REPEATED
    told = (rest > 0) & (
        (nines & (largest > _ABOVE_NINES * rest)) | (often & (largest > _ABOVE_ALL * rest))
    )
    of_told = values[:, told]
    numbers = np.unique(of_told[np.abs(of_told) == largest[told]])
    remarks = (
        f"{number:.10g} stands where nothing else of the channel is near: {_READ_AS_MISSING}"
        for number in numbers
    )
    return np.isin(values, numbers), tuple(remarks)


def _measure_sizes(values: Array) -> tuple[Array, Index, Array]:
    """Return the largest size in each channel (D,), how often it occurs, and the next one."""
    highest, lowest = np.fmax.reduce(values, initial=0.0), np.fmin.reduce(values, initial=0.0)
    largest = np.maximum(highest, -lowest)  # whatever is NaN
    count, rest = np.zeros(len(largest), dtype=np.intp), np.zeros(len(largest))
    for at in range(0, len(values), _BLOCK):
        sizes = np.abs(values[at : at + _BLOCK])
        is_largest = sizes == largest
        count += is_largest.sum(axis=0)
        rest = np.fmax(rest, np.fmax.reduce(np.where(is_largest, 0.0, sizes), axis=0))
    return largest, count, rest


def _is_nines(size: float) -> bool:
    digits = f"{size:.10g}".replace(".", "")
    return len(digits) >= _FEWEST_NINES and set(digits) == {"9"}


def _tell_held(recording: Recording) -> Told:
    """Tell held values by a sudden end, where the marker leaps to where it has been going."""
    markers = markers_of(recording.channels, recording.units)
    mask = _nothing(recording)
    told: dict[str, int] = {}
    for name, start, stop, sudden in find_held(recording):
        if sudden:
            mask[start:stop, list(markers[name])] = True
            told[name] = told.get(name, 0) + stop - start
    if not told:
        return mask, ()
    keep, leap = ("keeps", "leaps") if len(told) == 1 else ("keep", "leap")
    return (
        mask,
        (
            f"{join_names([*told], _NAMED)} {keep} the position of the frame before for "
            f"{_most_frames(told)} while others move, and {leap} on: {_READ_AS_MISSING}",
        ),
    )


def find_held(recording: Recording) -> Iterator[tuple[str, int, int, bool]]:
    """Yield each marker that is exactly where it was before, and in which frames [start, stop).

    With them goes whether it leaps before or after them, while at least half of the others move.
    Where coordinates have so few digits that single ones repeat often, all may by themselves, and
    nothing is said of the marker.
    """
    markers = markers_of(recording.channels, recording.units)
    places = np.array([*markers.values()], dtype=np.intp).reshape(-1, 3)
    masks = recording.visible, _repeat_last(recording.values), recording.values == 0.0
    # By marker (M, 3, N): what is looked at together is close together in memory.
    visible, same, zero = (np.take(mask.T, places, axis=0) for mask in masks)
    both = np.asarray(visible.all(axis=1))
    both[:, 1:] &= both[:, :-1].copy()
    both[:, :1] = False
    held = both & same.all(axis=1) & ~zero.all(axis=1)
    others_move = 2 * (both & ~held).sum(axis=0) >= np.maximum(2, both.sum(axis=0))
    for number, name in enumerate(markers):
        if _is_fine([axis[both[number] & ~held[number]] for axis in same[number]]):
            for start, stop in run_bounds(held[number]).tolist():
                if stop - start >= _LEAST_HELD:
                    alone = bool(others_move[start:stop].mean() >= _MOSTLY)
                    values = recording.values[:, places[number]]
                    yield name, start, stop, alone and _is_sudden(values, start, stop)


def _is_fine(same: Sequence[Mask]) -> bool:
    """Return whether coordinates (3, K) have so many digits that hardly any repeats in a step.

    A coordinate that never changes does not count.
    """
    shares = np.array([np.mean(axis) if len(axis) else 1.0 for axis in same])
    changing = shares[shares < 1.0]
    return bool(len(changing) and changing.mean() <= _COARSE)


def _is_sudden(values: Array, start: int, stop: int) -> bool:
    """Return whether a marker (N, 3) that is held in frames [start, stop) leaps before or after.

    What comes to rest slows down before, and what starts to move does so slowly.
    """
    steps = np.linalg.norm(np.diff(values, axis=0, prepend=np.nan), axis=1)
    usual = np.median(steps[steps > 0])
    before, leap, after = (
        steps[frame] if frame < len(steps) else np.nan for frame in (start - 1, stop, stop + 1)
    )
    if np.isnan(leap) or np.isnan(before):  # at the end or the beginning
        return bool(np.nanmax([before, leap, 0.0]) >= _LEAST_STEP * usual)
    return bool(leap > _LEAP * np.nanmax([before, after]))


def _nothing(recording: Recording) -> Mask:
    return np.zeros(recording.values.shape, dtype=bool)


def _all_zeros(recording: Recording) -> Mask:
    """Return where markers, and channels of no marker, are 0."""
    return _in_whole_markers(recording, np.equal(recording.values, 0.0))


def _all_held(recording: Recording) -> Mask:
    """Return where markers, and channels of no marker, keep the value of the frame before.

    Those that never change keep it, too.
    """
    whole = _in_whole_markers(recording, _repeat_last(recording.values))
    return whole & ~whole[1:].all(axis=0)


def _equal_values(number: float, recording: Recording) -> Mask:
    return np.equal(recording.values, number)


def _repeat_last(values: Array) -> Mask:
    """Return where values (N, ...) are those of the frame before."""
    same = np.zeros(values.shape, dtype=bool)
    same[1:] = np.equal(values[1:], values[:-1])
    return same


def _in_whole_markers(recording: Recording, mask: Mask) -> Mask:
    """Return the mask without entries of points of which not all coordinates are in it."""
    result = mask.copy()
    for places in map(list, points_of(recording.channels, recording.units).values()):
        result[:, places] = mask[:, places].all(axis=1, keepdims=True)
    return result


_MARKS: Mapping[str, Callable[[Recording], Mask]] = {
    "zeros": _all_zeros,
    "held": _all_held,
    "none": _nothing,
}
