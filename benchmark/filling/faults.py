"""Faults that touch a gap to fill, as models learn from the frames beside it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import Any

from mocapbench.benchmark import recording_checks
from mocapbench.benchmark.filling.gaps import Gap
from mocapbench.benchmark.filling.requests.names import name_hidden_markers
from mocapbench.benchmark.filling.requests.request import FillRequest
from mocapbench.datasets.formats.strays import list_measured

__all__ = ["describe_faults", "find_faults_at_gaps", "tabulate_faults"]

_NAMED = 3
"""Markers, or pairs, with faults of a kind that a sentence names at most."""
_BESIDE = 5
"""Frames between a fault and a gap beside it at most."""
Fault = dict[str, Any]


def find_faults_at_gaps(request: FillRequest) -> list[Fault]:
    """Return the faults of markers within or beside a gap of theirs that is to be filled.

    They are the gravest kinds first, as `mocapbench inspect` lists them in JSON.
    """
    given = request.given
    measured = given.select(list_measured(given.channels, request.results))
    gaps: dict[str, list[Gap]] = defaultdict(list)
    for gap in request.gaps:
        for name in name_hidden_markers(given.channels, [gap]):
            gaps[name].append(gap)
    touching = [
        fault
        for fault in recording_checks.list_faults(measured)
        if any(_is_beside(fault, gap) for name in fault["markers"] for gap in gaps[name])
    ]
    kinds = [*recording_checks.TITLES]
    return sorted(touching, key=lambda fault: kinds.index(fault["kind"]))


def _is_beside(fault: Fault, gap: Gap) -> bool:
    """Return whether a fault touches a gap, or frames near it."""
    return bool(fault["start"] <= gap.stop + _BESIDE and gap.start <= fault["stop"] + _BESIDE)


def describe_faults(faults: Sequence[Fault]) -> Iterator[str]:
    """Yield a sentence on the faults of each kind."""
    for kind, of_kind in groupby(faults, key=lambda fault: fault["kind"]):
        groups = recording_checks.group_findings([*of_kind])
        told = "; ".join(map(recording_checks.describe_together, groups[:_NAMED]))
        more = f"; and {len(groups) - _NAMED} others" if len(groups) > _NAMED else ""
        advice = " --hide-spikes hides spikes first." if kind == "spike" else ""
        title = recording_checks.TITLES[kind]
        yield f"{title[0].upper()}{title[1:]}, at gaps: {told}{more}.{advice}"


def tabulate_faults(faults: Sequence[Fault]) -> Iterator[tuple[str, str, str, str]]:
    """Yield of each fault what it is, of which markers, in which frames, and how large."""
    for fault in faults:
        yield (
            recording_checks.TITLES[fault["kind"]],
            " and ".join(fault["markers"]),
            recording_checks.describe_frames(fault),
            recording_checks.describe_size(fault),
        )
