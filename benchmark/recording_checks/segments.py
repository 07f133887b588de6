"""Segments: pairs of markers that stay equally far apart, and frames in which they do not."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd

from mocapbench.basics.arrays import Array
from mocapbench.basics.mask_runs import run_bounds
from mocapbench.benchmark.recording_checks.findings_table import (
    MarkerPaths,
    measure_extent,
    tabulate_findings,
)

__all__ = ["find_segment_jumps"]

_STIFF, _QUANTILE = 0.05, 0.9
"""How much of its length a segment differs from the median at most, but for a tenth of frames."""
_BEYOND, _FLOOR = 5.0, 0.015
"""How many times that quantile the length of a segment differs where it is wrong, and how much of
the extent of all markers, at least."""
_FEWEST = 30
"""Frames in which both markers are seen, at least, to tell whether they are a segment."""


def find_segment_jumps(paths: MarkerPaths) -> pd.DataFrame:
    """Return in which frames the length of a segment is not what it is in most others.

    A segment is a marker and the one whose distance from it varies least.

    Returns
    -------
    DataFrame
        A row each with the kind ``segment``; the size is the most by which the length differs.
    """
    least = _FLOOR * measure_extent(paths.positions)
    rows = []
    for one, other, differences, spread in _find_segments(paths.positions):
        wrong = differences > max(_BEYOND * spread, least)
        for start, stop in run_bounds(wrong).tolist():
            pair = (paths.names[one], paths.names[other])
            rows.append(("segment", pair, start, stop, float(differences[start:stop].max())))
    return tabulate_findings(rows)


def _find_segments(positions: Array) -> Iterator[tuple[int, int, Array, float]]:
    """Yield the markers of each segment, the differences (N,) of its length, and their spread."""
    found = set()
    for one in range(positions.shape[1]):
        lengths = np.linalg.norm(positions - positions[:, [one]], axis=2)
        lengths[:, np.isfinite(lengths).sum(axis=0) < _FEWEST] = np.nan
        usable = np.flatnonzero(np.isfinite(lengths).any(axis=0))
        usable = usable[usable != one]
        if not len(usable):
            continue
        lengths = lengths[:, usable]
        usual = np.nanmedian(lengths, axis=0)
        differences = np.abs(lengths - usual)
        spreads = np.nanquantile(differences, _QUANTILE, axis=0)
        best = int(np.argmin(spreads))
        pair = (min(one, int(usable[best])), max(one, int(usable[best])))
        if spreads[best] <= _STIFF * usual[best] and pair not in found:
            found.add(pair)
            yield *pair, differences[:, best], float(spreads[best])
