"""What is still hidden in a filled file, as the page and the terminal say it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from mocapbench.basics.words import format_count, join_names
from mocapbench.benchmark.errors import first_of
from mocapbench.benchmark.filling.requests.names import marker_names
from mocapbench.benchmark.filling.requests.request import FillRequest

__all__ = ["remaining"]

_NAMED = 4
"""Markers or channels that a remark names at most."""


def remaining(request: FillRequest) -> Iterator[str]:
    """Yield how many gaps were left open, and how many entries stay hidden for other reasons."""
    if request.left_open:
        were = format_count(len(request.left_open), "longer gap was", "longer gaps were")
        yield f"{were} left open."
    if request.unlabelled:
        yield _unlabelled(marker_names(request.unlabelled))
    if request.outputs:
        yield _outputs(marker_names(request.outputs))
    if request.unknown:
        yield _unknown(marker_names(request.unknown))
    told = [*request.unlabelled, *request.outputs, *request.unknown]
    others = ~np.isin(request.given.channels, told)
    rest = int((~request.given.visible & ~request.target)[:, others].sum())
    if rest:
        stay = format_count(rest, "hidden entry stays", "hidden entries stay")
        yield f"{stay} hidden, since {'it was' if rest == 1 else 'they were'} not to be filled."


def _unlabelled(markers: Sequence[str]) -> str:
    stay, them = ("stays as it is", "it") if len(markers) == 1 else ("stay as they are", "them")
    return (
        f"{format_count(len(markers), 'unlabelled marker')} ({first_of(markers, _NAMED)}) {stay}: "
        f"name {them} with --channels to fill {them}."
    )


def _outputs(points: Sequence[str]) -> str:
    count = format_count(
        len(points), "result of a model of the body", "results of a model of the body"
    )
    stay, them = ("stays as it is", "it") if len(points) == 1 else ("stay as they are", "them")
    return (
        f"{count} ({first_of(points, _NAMED)}) {stay}, as the model gives {them} anew from filled "
        f"markers: name {them} with --channels to fill {them}."
    )


def _unknown(names: Sequence[str]) -> str:
    stay, them = (
        ("It stays as it is", "it") if len(names) == 1 else ("They stay as they are", "them")
    )
    return (
        f"Nothing is visible that {join_names(names, _NAMED)} could be filled from. {stay}: name "
        f"files that have {them} with --train."
    )
