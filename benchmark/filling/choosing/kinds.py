"""Kinds of gaps: a model that is best for one kind may be bad for another.

A joint that is lost for a tenth of a second is best interpolated, and one that is lost for two
seconds learnt from the others. Where nothing is visible, models of single markers have nothing to
go by. Angles and places differ in what they follow. So a model is chosen for each kind.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from mocapbench.basics.arrays import Index
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.filling.gaps import Gap, find_gaps
from mocapbench.datasets import Mask

__all__ = ["Kind", "tell_kinds"]

_LENGTHS = ((0.25, "up to 0.25 s"), (1.0, "up to 1 s"), (np.inf, "longer"))
"""Within a quarter of a second a limb hardly turns back; within a second a step ends."""


class Kind(NamedTuple):
    """What gaps of a kind have in common."""

    unit: str
    """The unit of their channels."""
    extent: str
    """How much is hidden at once: one marker or joint, several, or whole frames."""
    length: str
    """How long they are."""

    def __str__(self) -> str:
        return ", ".join(filter(None, (self.extent, self.length, self.unit)))


def tell_kinds(problem: GapProblem) -> Mapping[Gap, Mapping[Kind, tuple[int, ...]]]:
    """Return of each gap of a problem the kinds, with the channels of each.

    A gap in channels of several units is of several kinds.
    """
    units, step = np.array(problem.given.units), _measure_step(problem)
    markers, hidden = _number_markers(problem.given.channels), ~problem.given.visible
    kinds: dict[Gap, dict[Kind, tuple[int, ...]]] = {}
    for gap in find_gaps(problem.target):
        extent = _tell_extent(hidden[gap.start : gap.stop], markers)
        length = next(text for most, text in _LENGTHS if len(gap) * step <= most)
        channels, of_gap = np.array(gap.channels), units[list(gap.channels)]
        kinds[gap] = {
            Kind(unit, extent, length): tuple(channels[of_gap == unit].tolist())
            for unit in sorted({*of_gap.tolist()})
        }
    return kinds


def _measure_step(problem: GapProblem) -> float:
    """Return the seconds from frame to frame; rounded, so that digits of times do not count."""
    times = problem.given.times
    return round(float(np.median(np.diff(times))), 6) if len(times) > 1 else 0.0


def _number_markers(channels: tuple[str, ...]) -> Index:
    """Return the number of the marker or joint that each channel (D,) belongs to."""
    stems = [name.rpartition(".")[0] or name for name in channels]
    return np.unique(stems, return_inverse=True)[1]


def _tell_extent(hidden: Mask, markers: Index) -> str:
    """Return how much is hidden at once in most frames of a mask (n, D)."""
    if np.mean(hidden.all(axis=1)) > 0.5:
        return "whole frames"
    order = np.argsort(markers, kind="stable")
    starts = np.flatnonzero(np.diff(markers[order], prepend=-1))
    count = np.logical_or.reduceat(hidden[:, order], starts, axis=1).sum(axis=1)
    return "one marker or joint" if np.median(count) <= 1 else "several markers or joints"
