"""Leaps: steps of a marker far beyond its own, as in spikes.

A step is compared with the median of the steps around it, which a spike of three frames does not
move, and the difference with those of the half second on either side, so that a marker may move as
it likes, but not leap.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd

from mocapbench.basics.arrays import Array, Mask
from mocapbench.basics.mask_runs import run_bounds
from mocapbench.benchmark.recording_checks.findings_table import tabulate_findings
from mocapbench.benchmark.recording_checks.paths import MotionPaths

__all__ = ["find_leaps", "find_spikes"]

_BEYOND = 6.0
"""How many times as large as what is usual a leap is, at least."""
_SPIKE, _BACK = 3, 0.5
"""Frames that a spike lasts at most, and how near to its path the marker comes back: as a share of
the leap."""
_LONE, _LONE_FLOOR = 2.0, 2.5
"""How many times as large as those before and after it a leap without return is, and as the least
leap: in a blow or a landing several differ in a row."""


def find_spikes(paths: MotionPaths) -> pd.DataFrame:
    """Return the spikes of markers or channels, and their jumps, which are leaps without return.

    Parameters
    ----------
    paths : MotionPaths

    Returns
    -------
    DataFrame
        A row each with the kind ``spike`` or ``jump``. A spike lasts up to three frames, or those
        between a leap and a gap. The frames of a jump are the two that it is between.
    """
    leaps = find_leaps(paths, _BEYOND)
    lone = _find_lone(paths.sizes, leaps, _LONE_FLOOR * paths.least_leaps)
    visible = ~np.isnan(paths.positions[..., 0])
    rows = [
        (kind, (paths.names[m],), start, stop, size)
        for m in np.flatnonzero(leaps.any(axis=0)).tolist()
        for kind, start, stop, size in _tell_spikes(
            paths.measure_excess(m), leaps[:, m], lone[:, m], visible[:, m]
        )
    ]
    return tabulate_findings(rows)


def find_leaps(paths: MotionPaths, beyond: float) -> Mask:
    """Return which steps (N - 1, M) exceed the median by so many times what is usual."""
    leaps = np.zeros_like(paths.may_leap)
    for m in np.flatnonzero(paths.may_leap.any(axis=0)).tolist():
        floor = np.maximum(beyond * paths.usual_sizes[:, m], paths.least_leaps[m])
        leaps[:, m] = paths.sizes[:, m] > floor
    return leaps


def _find_lone(sizes: Array, leaps: Mask, floor: Array) -> Mask:
    """Return which leaps (N - 1, M) exceed floors (M,), and the steps beside them by far."""
    lone, last = np.zeros_like(leaps), len(leaps) - 1
    steps, markers = np.nonzero(leaps)
    before = np.where(steps > 0, sizes[steps - 1, markers], 0.0)
    after = np.where(steps < last, sizes[(steps + 1).clip(max=last), markers], 0.0)
    beside = np.nan_to_num(np.fmax(before, after))
    lone[steps, markers] = sizes[steps, markers] > np.maximum(_LONE * beside, floor[markers])
    return lone


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
