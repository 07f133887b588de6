"""Leaps: steps of a marker far beyond its own, as in spikes, and where two markers trade places.

A step is compared with the median of the steps around it, which a spike of three frames does not
move, and the difference with those of the half second on either side, so that a marker may move as
it likes, but not leap.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

import numpy as np
import pandas as pd

from mocapbench.basics.arrays import Array, Index, Mask
from mocapbench.basics.mask_runs import run_bounds
from mocapbench.benchmark.recording_checks.findings_table import (
    MarkerPaths,
    measure_extent,
    tabulate_findings,
)

__all__ = ["find_spikes", "find_swaps"]

_STEPS, _NEAR = 9, 4
"""Steps of which the median is what a marker would do: around a step, and on one side of it."""
_SECONDS, _FRAMES, _QUANTILE = 0.5, 15, 0.9
"""On either side of a step, what its difference is compared with: that quantile, over these seconds
or frames, whichever is longer."""
_BEYOND, _FLOOR = 6.0, 0.006
"""How many times as large as that quantile a leap is, and as the markers' extent, at least."""
_SPIKE, _BACK = 3, 0.5
"""Frames that a spike lasts at most, and how near to its path the marker comes back: as a share of
the leap."""
_LONE, _LONE_FLOOR = 2.0, 0.015
"""How many times as large as those before and after it a leap without return is, and as the extent,
at least: in a blow or a landing several differ in a row."""
_SWAP_BEYOND, _LONGEST, _FIT = 3.0, 0.5, 0.3
"""As `_BEYOND`, in each of two markers; seconds of a gap beside which markers trade places at most;
and how well the traded paths fit: as a share of how badly the given ones do."""


def find_spikes(paths: MarkerPaths) -> pd.DataFrame:
    """Return the spikes of markers, and their jumps, which are leaps without return.

    Parameters
    ----------
    paths : MarkerPaths

    Returns
    -------
    DataFrame
        A row each with the kind ``spike`` or ``jump``. A spike lasts up to three frames, or those
        between a leap and a gap. The frames of a jump are the two that it is between.
    """
    excess = _measure_excess(paths.positions)
    leaps = _find_leaps(paths, excess, _BEYOND)
    lone = leaps & _find_lone(excess, _LONE_FLOOR * measure_extent(paths.positions))
    visible = ~np.isnan(paths.positions[..., 0])
    rows = [
        (kind, (paths.names[m],), start, stop, size)
        for m in np.flatnonzero(leaps.any(axis=0)).tolist()
        for kind, start, stop, size in _tell_spikes(
            excess[:, m], leaps[:, m], lone[:, m], visible[:, m]
        )
    ]
    return tabulate_findings(rows)


def find_swaps(paths: MarkerPaths) -> pd.DataFrame:
    """Return where two markers trade places, from one frame to the next or beside a gap.

    Two paths are traded if each goes on where the other was going, and neither where it was.

    Parameters
    ----------
    paths : MarkerPaths

    Returns
    -------
    DataFrame
        A row each with the kind ``swap``, from the frame in which places are traded to that in
        which they are traded back, or to the end. The size is the distance that the markers leap.
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


def _measure_excess(positions: Array) -> Array:
    """Return by how much each step differs from the median of those around it (N - 1, M, 3)."""
    steps = np.diff(positions, axis=0)
    return np.asarray(steps - _roll(steps, _STEPS, "median", center=True))


def _roll(steps: Array, window: int, statistic: str, center: bool = False) -> Array:
    """Return the statistic over so many visible steps (K, ...) around or before each."""
    table = pd.DataFrame(steps.reshape(len(steps), int(np.prod(steps.shape[1:]))))
    rolling = table.rolling(window, min_periods=1, center=center)
    rolled = rolling.median() if statistic == "median" else rolling.quantile(_QUANTILE)
    return np.asarray(rolled, dtype=np.float64).reshape(steps.shape)


def _find_leaps(paths: MarkerPaths, excess: Array, beyond: float) -> Mask:
    """Return which steps (N - 1, M) are far beyond the marker's own."""
    sizes = np.linalg.norm(excess, axis=2)
    half = max(_FRAMES, int(np.nan_to_num(paths.rate) * _SECONDS))
    usual = _roll(sizes, 2 * half + 1, "quantile", center=True)
    floor = _FLOOR * measure_extent(paths.positions)
    return np.asarray(sizes > np.maximum(beyond * usual, floor))


def _find_lone(excess: Array, floor: float) -> Mask:
    """Return which steps (N - 1, M) differ by more than a floor, and than those beside them."""
    sizes = np.pad(np.nan_to_num(np.linalg.norm(excess, axis=2)), ((1, 1), (0, 0)))
    beside = np.maximum(sizes[:-2], sizes[2:])
    return np.asarray(sizes[1:-1] > np.maximum(_LONE * beside, floor))


def _tell_spikes(
    excess: Array, leaps: Mask, lone: Mask, visible: Mask
) -> Iterator[tuple[str, int, int, float]]:
    """Yield kind, frames and size of spikes and jumps of a marker, whose steps are (N - 1, 3)."""
    bounds = run_bounds(visible).tolist()
    steps = np.flatnonzero(leaps).tolist()
    while steps:
        first, *steps = steps
        start, stop = next(pair for pair in bounds if pair[0] <= first < pair[1])
        size = float(np.linalg.norm(excess[first]))
        back = [last for last in steps if last - first <= _SPIKE and _returns(excess, first, last)]
        if back:
            steps = [step for step in steps if step > back[-1]]
            yield "spike", first + 1, back[-1] + 1, size
        elif first + 1 - start <= _SPIKE and start > 0:
            yield "spike", start, first + 1, size
        elif stop - (first + 1) <= _SPIKE and stop < len(visible):
            steps = [step for step in steps if step >= stop]
            yield "spike", first + 1, stop, size
        elif lone[first]:
            yield "jump", first, first + 2, size


def _returns(excess: Array, first: int, last: int) -> bool:
    """Return whether a marker that leaps in one step is on its way again after another."""
    largest = max(np.linalg.norm(excess[first]), np.linalg.norm(excess[last]))
    off = np.linalg.norm(excess[first : last + 1].sum(axis=0))
    return bool(off <= _BACK * largest)


def _find_trades(paths: MarkerPaths) -> Iterator[tuple[int, int, int, float]]:
    """Yield which two markers trade places, the first frame after it, and how far they leap."""
    positions = paths.positions
    steps = np.diff(positions, axis=0)
    before = np.nan_to_num(_roll(steps, _NEAR, "median"))
    after = np.nan_to_num(_roll(steps[::-1], _NEAR, "median")[::-1])
    marker, last, first = _find_breaks(paths)
    floor = _FLOOR * measure_extent(positions)

    def miss(one: Index, other: Index) -> Array:
        """Return by how much paths before breaks miss those after others."""
        frames = (first[other] - last[one])[:, None]
        speed = before[np.maximum(last[one] - 1, 0), marker[one]]
        speed = speed + after[np.minimum(first[other], len(steps) - 1), marker[other]]
        way = positions[first[other], marker[other]] - positions[last[one], marker[one]]
        return np.asarray(np.linalg.norm(way - frames * speed / 2, axis=1))

    for one, other in _pair_breaks(marker, last, first):
        given = np.minimum(miss(one, one), miss(other, other))
        traded = np.maximum(miss(one, other), miss(other, one))
        for k in np.flatnonzero((given > floor) & (traded <= _FIT * given)).tolist():
            a, b = sorted((int(marker[one[k]]), int(marker[other[k]])))
            yield a, b, int(max(first[one[k]], first[other[k]])), float(given[k])


def _find_breaks(paths: MarkerPaths) -> tuple[Index, Index, Index]:
    """Return leaps and inner gaps: the marker, the last frame before and the first after, by it."""
    leaps = _find_leaps(paths, _measure_excess(paths.positions), _SWAP_BEYOND)
    breaks = [(marker, step, step + 1) for step, marker in np.argwhere(leaps).tolist()]
    longest = max(1, int(np.nan_to_num(paths.rate) * _LONGEST))
    for marker, hidden in enumerate(np.isnan(paths.positions[..., 0]).T):
        for start, stop in run_bounds(hidden).tolist():
            if start > 0 and stop < len(hidden) and stop - start <= longest:
                breaks.append((marker, start - 1, stop))
    table = np.array(sorted(breaks, key=lambda each: each[1:]), dtype=np.intp).reshape(-1, 3)
    return table[:, 0], table[:, 1], table[:, 2]


def _pair_breaks(marker: Index, last: Index, first: Index) -> Iterator[tuple[Index, Index]]:
    """Yield breaks with those of other markers that overlap them and do not come before."""
    for k in range(len(marker)):
        others = np.arange(k + 1, np.searchsorted(last, first[k]))
        others = others[marker[others] != marker[k]]
        if len(others):
            yield np.full(len(others), k), others
