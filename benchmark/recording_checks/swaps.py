"""Swaps: where two markers trade places, from one frame to the next or across gaps.

Two things tell which of two markers is which after a break: where each was going, and how far each
was from the others, which bones and rigid segments keep. Both are measured in what is usual of the
same marker over as many frames.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

import numpy as np
import pandas as pd

from mocapbench.basics.arrays import Array, Index
from mocapbench.basics.mask_runs import run_bounds
from mocapbench.benchmark.recording_checks.findings_table import tabulate_findings
from mocapbench.benchmark.recording_checks.leaps import find_leaps
from mocapbench.benchmark.recording_checks.paths import MotionPaths, measure_lengths

__all__ = ["find_swaps"]

_BEYOND, _LONGEST = 3.0, 2.0
"""How far beyond its own a step of either marker is, and seconds of a gap at most."""
_NEAR = 4
"""Steps on one side of a break of which the median is where a marker goes."""
_QUANTILE, _SAMPLES = 0.75, 400
"""Of how much a marker moves or its distances change, over as many frames as a break lasts, this
quantile is usual, in so many places of the recording."""
_STILL, _APART = 0.001, 0.006
"""The least that is usual, and how far apart places are at least: as shares of the extent."""
_PER_OCTAVE = 2
"""Of numbers of frames that count as one."""
_TOGETHER = 2000
"""Pairs of breaks that are compared at once."""
_TELLING = 6
"""Other markers whose distances are compared: those that tell the two apart best."""
_GAIN = 1.0
"""How much better each marker fits where the other is: the least gain in log likelihood, in Cauchy
distributions, of its motion and of the mean distance. Of 297 gaps that were cut into real
recordings without a swap, all gains were below -0.3; of swaps in them, nine of ten are above 1."""

Breaks = tuple[Index, Index, Index]
"""Of each of K leaps and gaps, the marker, the last frame before it and the first after it."""


def find_swaps(paths: MotionPaths) -> pd.DataFrame:
    """Return where two markers trade places, from one frame to the next or across gaps.

    Parameters
    ----------
    paths : MotionPaths

    Returns
    -------
    DataFrame
        A row each with the kind ``swap``, from the frame in which places are traded to that in
        which they are traded back, or to the end. The size is how far apart they are.
    """
    trades: dict[tuple[int, int], list[tuple[int, float]]] = defaultdict(list)
    for one, other, frame, size in _find_trades(paths):
        trades[one, other].append((frame, size))
    n_frames = len(paths.positions)
    rows = []
    for (one, other), each in sorted(trades.items()):
        each.sort()
        ends = [*each[1::2], (n_frames, 0.0)][: len(each[::2])]
        for (start, size), (stop, _) in zip(each[::2], ends, strict=True):
            rows.append(("swap", (paths.names[one], paths.names[other]), start, stop, size))
    return tabulate_findings(rows)


def _find_trades(paths: MotionPaths) -> Iterator[tuple[int, int, int, float]]:
    """Yield which two markers trade places, the first frame after it, and how far apart."""
    breaks = _find_breaks(paths)
    marker, _, first = breaks
    usual, apart = _measure_usual(paths, *breaks), _APART * paths.extent
    for one, other in _pair_breaks(*breaks):
        gains = np.minimum(
            _compare_misses(paths, breaks, one, other, usual),
            _compare_misses(paths, breaks, other, one, usual),
        )
        places = [paths.positions[first[each], marker[each]] for each in (one, other)]
        sizes = np.linalg.norm(np.subtract(*places), axis=1)
        for k in np.flatnonzero((gains > _GAIN) & (sizes > apart)).tolist():
            a, b = sorted((int(marker[one[k]]), int(marker[other[k]])))
            yield a, b, int(max(first[one[k]], first[other[k]])), float(sizes[k])


def _compare_misses(
    paths: MotionPaths, breaks: Breaks, one: Index, other: Index, usual: Array
) -> Array:
    """Return how much better K paths go on after the breaks of others than after their own."""
    marker, last, first = breaks
    before, after = (marker[one], last[one]), (marker[other], first[other])
    given = _measure_misses(paths, *before, marker[one], first[one]) / usual[one]
    traded = _measure_misses(paths, *before, *after) / usual[one]
    gains = np.log1p(given**2) - np.log1p(traded**2)
    # How well each marker beside tells the two apart was known before the breaks.
    away = _measure_misses(paths, *before, marker[other], last[other]) / usual[one]
    known = np.isfinite(gains)
    away, gains = np.where(known, away, -1.0), np.where(known, gains, 0.0)
    telling = 1 + np.argsort(-away[:, 1:], axis=1)[:, :_TELLING]
    count, total = (
        np.take_along_axis(each, telling, axis=1).sum(axis=1) for each in (known, gains)
    )
    return np.asarray(gains[:, 0] + total / np.maximum(count, 1))


def _measure_misses(
    paths: MotionPaths, one: Index, last: Index, other: Index, first: Index
) -> Array:
    """Return how badly markers' paths until frames go on as those of others from frames on.

    Of each of K, how far the second is from where the first was going, and then by how much their
    distances from each of M markers differ, NaN for the two themselves: (K, 1 + M).
    """
    start, end = paths.positions[last, one], paths.positions[first, other]
    speed = _measure_speed(paths, one, last - _NEAR) + _measure_speed(paths, other, first)
    off = np.linalg.norm(end - start - (first - last)[:, None] * speed / 2, axis=1)
    change = np.abs(_measure_distances(paths, start, last) - _measure_distances(paths, end, first))
    change[np.arange(len(one)), one] = change[np.arange(len(one)), other] = np.nan
    return np.column_stack([off, change])


def _measure_distances(paths: MotionPaths, places: Array, frames: Index) -> Array:
    """Return how far each of K places is from M markers in a frame each (K, M)."""
    return measure_lengths(paths.positions[frames] - places[:, None])


def _measure_speed(paths: MotionPaths, marker: Index, frames: Index) -> Array:
    """Return the median (K, 3) of few steps from a frame on; 0 where none of them is visible."""
    near = frames[:, None] + np.arange(_NEAR)
    last = len(paths.missing_rows) - 1
    inside = (near >= 0) & (near <= last)
    steps = paths.take_steps(near.clip(0, last), marker[:, None])
    steps[~inside] = np.nan
    ordered, count = np.sort(steps, axis=1), (~np.isnan(steps)).sum(axis=1, keepdims=True)
    low, high = ((count - 1) // 2).clip(min=0), count // 2
    middle = [np.take_along_axis(ordered, place, axis=1)[:, 0] for place in (low, high)]
    return np.nan_to_num((middle[0] + middle[1]) / 2)  # NumPy's median takes ten times as long


def _measure_usual(paths: MotionPaths, marker: Index, last: Index, first: Index) -> Array:
    """Return what is usual of the misses of each of K markers over as many frames (K, 1 + M).

    Close numbers of frames count as one, so that little is measured twice.
    """
    n_frames, n_markers = paths.positions.shape[:2]
    usual = np.full((len(marker), 1 + n_markers), np.nan)
    spans = np.ceil(2 ** (np.round(_PER_OCTAVE * np.log2(first - last)) / _PER_OCTAVE))
    for one, span in sorted({*zip(marker.tolist(), spans.astype(int).tolist(), strict=True)}):
        starts = np.unique(np.linspace(0, n_frames - 1 - span, _SAMPLES).astype(np.intp))
        starts = starts[(starts >= 0) & ~np.isnan(paths.positions[starts, one, 0])]
        same = np.full(len(starts), one)
        misses = _measure_misses(paths, same, starts, same, starts + span)
        usual[(marker == one) & (spans == span)] = _take_quantile(misses, _QUANTILE)
    return np.maximum(usual, _STILL * paths.extent)


def _take_quantile(values: Array, quantile: float) -> Array:
    """Return the quantile of what is known in each column of (K, C); NaN where nothing is.

    NumPy's takes a column at a time.
    """
    if not len(values):
        return np.full(values.shape[1], np.nan)
    count = np.isfinite(values).sum(axis=0)
    place = np.maximum(np.ceil(quantile * count) - 1, 0).astype(np.intp)
    return np.asarray(np.sort(values, axis=0)[place, np.arange(values.shape[1])])


def _find_breaks(paths: MotionPaths) -> Breaks:
    """Return leaps and inner gaps: the marker, the last frame before and the first after, by it."""
    leaps = find_leaps(paths, _BEYOND)
    breaks = [(marker, step, step + 1) for step, marker in np.argwhere(leaps).tolist()]
    longest = max(1, int(np.nan_to_num(paths.rate) * _LONGEST))
    for marker, hidden in enumerate(np.isnan(paths.positions[..., 0]).T):
        for start, stop in run_bounds(hidden).tolist():
            if start > 0 and stop < len(hidden) and stop - start <= longest:
                breaks.append((marker, start - 1, stop))
    table = np.array(sorted(breaks, key=lambda each: each[1:]), dtype=np.intp).reshape(-1, 3)
    return table[:, 0], table[:, 1], table[:, 2]


def _pair_breaks(marker: Index, last: Index, first: Index) -> Iterator[tuple[Index, Index]]:
    """Yield breaks with those of other markers that overlap them and do not come before.

    They come in groups: one by one, thousands take minutes, and all at once, too much memory.
    """
    breaks = np.arange(len(marker))
    counts = np.maximum(np.searchsorted(last, first) - breaks - 1, 0)
    groups = np.cumsum(counts) // _TOGETHER
    for group in np.split(breaks, np.flatnonzero(np.diff(groups)) + 1):
        one = np.repeat(group, counts[group])
        starts = np.repeat(np.cumsum(counts[group]) - counts[group], counts[group])
        other = one + 1 + np.arange(len(one)) - starts
        apart = marker[one] != marker[other]
        if apart.any():
            yield one[apart], other[apart]
