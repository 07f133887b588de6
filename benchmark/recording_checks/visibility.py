"""Visibility: gaps of markers and of other channels, their ends, and frames that lack all."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd

from mocapbench.baselines.common.markers import markers_of
from mocapbench.basics.mask_runs import run_bounds
from mocapbench.benchmark.recording_checks.findings_table import tabulate_findings
from mocapbench.datasets import Recording
from mocapbench.datasets.formats.missing_rows import count_missing_rows

__all__ = ["find_hidden", "find_missing_rows", "place_markers"]


def find_hidden(recording: Recording) -> pd.DataFrame:
    """Return where markers, and channels of none, are hidden, and frames in which all are.

    Returns
    -------
    DataFrame
        A row each with the kind ``gap``; ``before`` the first frame in which a marker is seen or
        ``after`` the last; ``never`` where it is seen in none; and ``empty`` where nothing is seen.
        A marker of which one coordinate is hidden is not seen.
    """
    hidden = [
        (name, np.asarray(~recording.visible[:, places].all(axis=1)))
        for name, places in place_markers(recording)
    ]
    n_frames = len(recording.times)
    rows = [
        (_name_kind(start, stop, n_frames), (name,), start, stop, np.nan)
        for name, frames in hidden
        for start, stop in run_bounds(frames).tolist()
    ]
    if hidden:
        nothing = np.all([frames for _, frames in hidden], axis=0)
        rows += [("empty", (), *bounds, np.nan) for bounds in run_bounds(nothing).tolist()]
    return tabulate_findings(rows)


def find_missing_rows(recording: Recording) -> pd.DataFrame:
    """Return between which frames rows are missing, as times jump there.

    Returns
    -------
    DataFrame
        A row each with the kind ``rows``, the two frames, and how many rows are missing.
    """
    counts = count_missing_rows(len(recording.times), None, recording.times)
    rows = [("rows", (), k, k + 2, float(counts[k])) for k in np.flatnonzero(counts).tolist()]
    return tabulate_findings(rows)


def place_markers(recording: Recording) -> Iterator[tuple[str, list[int]]]:
    """Yield markers with the places of their coordinates, then channels that are of none."""
    markers = markers_of(recording.channels, recording.units)
    yield from ((name, list(places)) for name, places in markers.items())
    taken = {place for places in markers.values() for place in places}
    for place, channel in enumerate(recording.channels):
        if place not in taken:
            yield channel, [place]


def _name_kind(start: int, stop: int, n_frames: int) -> str:
    if stop == n_frames:
        return "after" if start else "never"
    return "gap" if start else "before"
