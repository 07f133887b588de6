"""Segments: pairs of markers that stay equally far apart, and frames in which they do not."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd

from mocapbench.basics.arrays import Array
from mocapbench.basics.mask_runs import run_bounds
from mocapbench.benchmark.recording_checks.findings_table import tabulate_findings
from mocapbench.benchmark.recording_checks.paths import MotionPaths

__all__ = ["find_segment_jumps"]

_STIFF, _QUANTILE = 0.05, 0.9
"""How much of its length a segment differs from the median at most, but for a tenth of frames."""
_BEYOND, _FLOOR = 5.0, 0.015
"""How many times that quantile the length of a segment differs where it is wrong, and how much of
the extent of all markers, at least."""
_SAMPLES = 2000
"""Frames in which segments are sought."""
_FEWEST = 30
"""Frames in which both markers are seen, at least, to tell whether they are a segment."""


def find_segment_jumps(paths: MotionPaths) -> pd.DataFrame:
    """Return in which frames the length of a segment is not what it is in most others.

    A segment is a marker and the one whose distance from it varies least.

    Returns
    -------
    DataFrame
        A row each with the kind ``segment``; the size is the most by which the length differs.
    """
    least = _FLOOR * paths.extent
    rows = []
    for one, other, differences, spread in _find_segments(paths.positions):
        wrong = differences > max(_BEYOND * spread, least)
        for start, stop in run_bounds(wrong).tolist():
            pair = (paths.names[one], paths.names[other])
            rows.append(("segment", pair, start, stop, float(differences[start:stop].max())))
    return tabulate_findings(rows)


def _find_segments(positions: Array) -> Iterator[tuple[int, int, Array, float]]:
    """Yield the markers of each segment, the differences (N,) of its length, and their spread.

    In long recordings, the marker whose distance varies least is sought in some frames.
    """
    some = np.linspace(0, len(positions) - 1, min(len(positions), _SAMPLES)).astype(np.intp)
    pairs = {
        pair for one in range(positions.shape[1]) for pair in _find_stiffest(positions[some], one)
    }
    for one, other in sorted(pairs):
        lengths = np.linalg.norm(positions[:, one] - positions[:, other], axis=1)
        usual = np.nanmedian(lengths)
        differences = np.abs(lengths - usual)
        spread = float(np.nanquantile(differences, _QUANTILE))
        if spread <= _STIFF * usual:
            yield one, other, differences, spread


def _find_stiffest(positions: Array, one: int) -> Iterator[tuple[int, int]]:
    """Yield a marker and the one whose distance from it varies least, if any is seen with it."""
    lengths = np.linalg.norm(positions - positions[:, [one]], axis=2)
    usable = np.isfinite(lengths).sum(axis=0) >= _FEWEST
    usable[one] = False
    if usable.any():
        others, lengths = np.flatnonzero(usable), lengths[:, usable]
        differences = np.abs(lengths - np.nanmedian(lengths, axis=0))
        best = int(others[np.argmin(np.nanquantile(differences, _QUANTILE, axis=0))])
        yield min(one, best), max(one, best)
