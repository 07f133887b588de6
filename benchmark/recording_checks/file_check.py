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
from mocapbench.basics.words import format_count, join_names
from mocapbench.benchmark.filling.reading import Reading
from mocapbench.benchmark.recording_checks.findings_table import find_paths, tabulate_findings
from mocapbench.benchmark.recording_checks.leaps import find_spikes, find_swaps
from mocapbench.benchmark.recording_checks.segments import find_segment_jumps
from mocapbench.benchmark.recording_checks.visibility import find_hidden
from mocapbench.datasets import Recording, frame_rate
from mocapbench.datasets.formats.strays import is_unlabelled

__all__ = ["check_file", "describe_check", "find_all"]

_NAMED = 4
"""Names in a sentence at most."""
_TITLES = {
    "gap": "gaps",
    "before": "not seen before the first time",
    "after": "not seen after the last time",
    "never": "never seen",
    "empty": "frames without any marker",
    "spike": "spikes",
    "jump": "jumps",
    "swap": "two markers trade places",
    "segment": "another distance than usual",
}
_SHOWN = 10
"""Findings of a kind in the terminal at most; JSON has all."""


def check_file(path: Path, reading: Reading) -> dict[str, Any]:
    """Return what a careful technician would look for in a file, ready for JSON.

    Frames count from 0, and those of a finding are [start, stop).

    Raises
    ------
    FormatError, UsageError
        If it cannot be read.
    """
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        recording, remarks = reading.read(path)
        results = reading.format_of(path).results(path, recording.channels)
    said = [str(each.message) for each in caught]
    strays = [*filter(is_unlabelled, recording.channels)]
    left_alone = {*results, *strays}
    kept = recording.select([name for name in recording.channels if name not in left_alone])
    seconds = float(recording.times[-1] - recording.times[0]) if len(recording.times) else 0.0
    rate = frame_rate(recording)
    return {
        "file": str(path),
        "frames": len(recording.times),
        "rate": rate if isfinite(rate) else None,
        "seconds": seconds,
        "channels": len(recording.channels),
        "units": sorted(set(recording.units)),
        "markers": [*markers_of(kept.channels, kept.units)],
        "unlabelled": _name_points(recording.select(strays)),
        "results": _name_points(recording.select(results)),
        "remarks": [*dict.fromkeys(said), *remarks],
        "findings": _list_rows(find_all(kept)),
    }


def _list_rows(findings: pd.DataFrame) -> list[dict[str, Any]]:
    """Return findings as JSON has them, where there is no NaN."""
    rows = findings.astype({"size": float}).to_dict("records")
    return [
        {**{str(key): value for key, value in row.items()}, "size": _drop_nan(row["size"])}
        for row in rows
    ]


def _drop_nan(number: float) -> float | None:
    return number if isfinite(number) else None


def find_all(recording: Recording) -> pd.DataFrame:
    """Return all findings of a recording; what one fault explains is not found again as another."""
    paths = find_paths(recording, frame_rate(recording))
    swaps, spikes, segments = find_swaps(paths), find_spikes(paths), find_segment_jumps(paths)
    spikes = _leave_out(spikes, swaps)
    # Of a marker that trades places, no length is the usual one.
    throughout = swaps.assign(start=0, stop=len(recording.times))
    segments = _leave_out(_leave_out(segments, spikes), throughout)
    tables = [find_hidden(recording), swaps, spikes, segments]
    return tabulate_findings([row for table in tables for row in table.itertuples(index=False)])


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


def _name_points(recording: Recording) -> list[str]:
    """Return the names of markers, and of channels that are of none."""
    markers = markers_of(recording.channels, recording.units)
    places = {place for each in markers.values() for place in each}
    others = [name for place, name in enumerate(recording.channels) if place not in places]
    return [*markers, *others]


def describe_check(check: dict[str, Any]) -> Iterator[str]:
    """Yield the lines that say what `check_file` returned."""
    rate = "one frame only" if check["rate"] is None else f"{check['rate']:.6g} frames per second"
    units = ", ".join(unit or "no unit" for unit in check["units"]) or "no unit"
    yield (
        f"{check['file']}: {format_count(check['frames'], 'frame')}, {rate}, "
        f"{check['seconds']:.3f} s; {format_count(check['channels'], 'channel')} in {units}; "
        f"{format_count(len(check['markers']), 'marker')}"
    )
    for key, words in (("unlabelled", "unlabelled"), ("results", "results of a model")):
        if names := check[key]:
            yield f"  {words}, not checked ({len(names)}): {join_names(names, _NAMED)}"
    yield from (f"  {text}" for text in check["remarks"])
    for kind, title in _TITLES.items():
        yield from _describe_kind(title, [row for row in check["findings"] if row["kind"] == kind])
    if not check["findings"]:
        yield "  no gap, spike, jump, swap or odd segment was found"


def _describe_kind(title: str, rows: list[dict[str, Any]]) -> Iterator[str]:
    """Yield a line on findings of one kind and one on each, up to a number."""
    if not rows:
        return
    yield f"  {title}: {len(rows)}"
    for row in rows[:_SHOWN]:
        names = " and ".join(row["markers"]) + ": " if row["markers"] else ""
        size = "" if row["size"] is None else f", {row['size']:.4g} in the file's unit"
        last, count = row["stop"] - 1, format_count(row["stop"] - row["start"], "frame")
        yield f"    {names}frames {row['start']} to {last} ({count}){size}"
    if len(rows) > _SHOWN:
        yield f"    and {len(rows) - _SHOWN} more; --json lists all"
