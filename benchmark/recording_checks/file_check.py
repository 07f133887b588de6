"""The check of a file: what it holds, what is to be said of it, and all findings."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from mocapbench.baselines.common.markers import markers_of
from mocapbench.benchmark.recording_checks.findings_table import unite_findings
from mocapbench.benchmark.recording_checks.leaps import find_spikes
from mocapbench.benchmark.recording_checks.marks import find_marks
from mocapbench.benchmark.recording_checks.paths import find_channel_paths, find_marker_paths
from mocapbench.benchmark.recording_checks.reading import Reading
from mocapbench.benchmark.recording_checks.segments import find_segment_jumps
from mocapbench.benchmark.recording_checks.swaps import find_swaps
from mocapbench.benchmark.recording_checks.visibility import (
    find_hidden,
    find_missing_rows,
    place_markers,
)
from mocapbench.datasets import Recording, frame_rate, unwrap_angles
from mocapbench.datasets.formats.strays import is_unlabelled, list_measured

__all__ = ["check_file", "find_all", "find_faults", "list_faults"]


def check_file(path: Path, reading: Reading) -> dict[str, Any]:
    """Return what a careful technician would look for in a file, ready for JSON.

    Returns
    -------
    dict
        With ``file``; how many ``frames``, their ``rate`` per second (null if there is but one) and
        ``seconds``; how many ``channels`` in which ``units``; the names of ``markers``, of other
        channels (``others``), and of ``unlabelled`` markers and ``results`` of a model, which are
        not checked; ``remarks`` on what the file says; and the ``findings``. Each has its ``kind``,
        the names of its ``markers`` or channels, its frames [``start``, ``stop``) from 0, the
        ``time`` of the first in seconds, and ``size`` and ``unit``, null where there are none.

    Raises
    ------
    FormatError, UsageError
        If it cannot be read.
    """
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        stated = reading.read_as_stated(path)
        missing, remarks = reading.missing(stated)
        results = reading.format_of(path).results(path, stated.channels)
    said = dict.fromkeys(str(each.message) for each in caught)
    strays = [*filter(is_unlabelled, stated.channels)]
    measured = list_measured(stated.channels, results)
    kept = np.isin(stated.channels, measured)
    recording = unwrap_angles(stated.hide(missing).select(measured))
    findings = unite_findings(
        find_marks(stated.select(measured), missing[:, kept]),
        find_all(recording),
    )
    markers = markers_of(recording.channels, recording.units)
    rate = frame_rate(recording)
    return {
        "file": str(path),
        "frames": len(recording.times),
        "rate": rate if isfinite(rate) else None,
        "seconds": float(np.ptp(recording.times)) if len(recording.times) else 0.0,
        "channels": len(stated.channels),
        "units": sorted(set(recording.units)),
        "markers": [*markers],
        "others": [name for name, _ in place_markers(recording) if name not in markers],
        "unlabelled": [name for name, _ in place_markers(stated.select(strays))],
        "results": [name for name, _ in place_markers(stated.select(results))],
        "remarks": [*said, *remarks],
        "findings": [*_list_findings(findings, recording)],
    }


def _list_findings(findings: pd.DataFrame, recording: Recording) -> Iterator[dict[str, Any]]:
    """Yield findings as JSON has them, where there is no NaN, with their times and units."""
    units = {name: recording.units[places[0]] for name, places in place_markers(recording)}
    for kind, markers, start, stop, size in findings.itertuples(index=False, name=None):
        yield {
            "kind": kind,
            "markers": [*markers],
            "start": start,
            "stop": stop,
            "time": float(recording.times[start]),
            "size": size if isfinite(size) else None,
            "unit": units[markers[0]] if markers and isfinite(size) else None,
        }


def list_faults(recording: Recording) -> list[dict[str, Any]]:
    """Return spikes, jumps, swaps and odd segments as `check_file` does."""
    return [*_list_findings(find_faults(recording), recording)]


def find_all(recording: Recording) -> pd.DataFrame:
    """Return all findings of a recording but values that mark missing ones."""
    return unite_findings(
        find_hidden(recording), find_missing_rows(recording), find_faults(recording)
    )


def find_faults(recording: Recording) -> pd.DataFrame:
    """Return spikes, jumps, swaps and odd segments; what one explains is not found as another."""
    paths = find_marker_paths(recording)
    swaps = find_swaps(paths)
    spikes = _leave_out(find_spikes(paths), swaps)
    # Of a marker that trades places, no length is the usual one.
    throughout = swaps.assign(start=0, stop=len(recording.times))
    segments = _leave_out(_leave_out(find_segment_jumps(paths), spikes), throughout)
    return unite_findings(swaps, spikes, segments, find_spikes(find_channel_paths(recording)))


def _leave_out(findings: pd.DataFrame, causes: pd.DataFrame) -> pd.DataFrame:
    """Return the findings without those that share a marker and a frame with a cause."""
    known = [*causes[["markers", "start", "stop"]].itertuples(index=False, name=None)]
    explained = [
        any(start <= end and begin <= stop and {*markers} & {*names} for names, begin, end in known)
        for markers, start, stop in zip(
            findings["markers"], findings["start"], findings["stop"], strict=True
        )
    ]
    return findings.loc[~np.array(explained, dtype=bool)]
