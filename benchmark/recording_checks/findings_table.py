"""Findings of a recording: a table with a row for each, and the paths of its markers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from mocapbench.baselines.common.markers import markers_of
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Recording

__all__ = ["COLUMNS", "MarkerPaths", "find_paths", "measure_extent", "tabulate_findings"]

COLUMNS = ("kind", "markers", "start", "stop", "size")
"""What it is, of which markers, in which frames [start, stop), and how large in their unit."""


class MarkerPaths(NamedTuple):
    """The paths of M markers, or joints, in N frames."""

    names: tuple[str, ...]
    positions: Array
    """(N, M, 3), NaN in all three coordinates of a marker where one is hidden."""
    rate: float
    """Frames per second; NaN if there is but one."""


def find_paths(recording: Recording, rate: float) -> MarkerPaths:
    """Return the paths of the markers of a recording."""
    places = markers_of(recording.channels, recording.units)
    positions = recording.values[:, np.array([*places.values()], dtype=np.intp).reshape(-1, 3)]
    hidden = np.isnan(positions).any(axis=2, keepdims=True)
    return MarkerPaths(tuple(places), np.where(hidden, np.nan, positions), rate)


def measure_extent(positions: Array) -> float:
    """Return how far apart markers (N, M, 3) are: the median over frames of the diagonal of a box.

    Of a person it is about 1.9 m. It makes thresholds independent of the unit, which some files do
    not state, and fit for hands as well as for groups of people.
    """
    frames = ~np.isnan(positions[..., 0]).all(axis=1)
    if not frames.any():
        return 0.0
    low, high = np.nanmin(positions[frames], axis=1), np.nanmax(positions[frames], axis=1)
    return float(np.median(np.linalg.norm(high - low, axis=1)))


def tabulate_findings(rows: Sequence[Sequence[Any]]) -> pd.DataFrame:
    """Return findings as a table, in the order of frames."""
    table = pd.DataFrame(list(rows), columns=list(COLUMNS))
    return table.sort_values(["start", "stop", "kind"], kind="stable", ignore_index=True)
