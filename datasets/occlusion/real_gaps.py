"""How long markers are lost in real files, and how many of them at about the same time.

The table has neither names nor coordinates: only lengths of gaps, in frames, a row for those that
overlap. ``docs/evidence/occlusion.py`` derives it from two files that others published: a reach
for a box by Vicon (``markers.csv`` of pyomeca), and a walk by OptiTrack
(``walkingOptiTrack.c3d`` of Kinetics Toolkit). Gaps at the ends of recordings are left out.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

__all__ = ["Occlusions", "real_gaps"]

Occlusions = tuple[float, Sequence[tuple[float, ...]]]
"""The seconds of a file, and the lengths in seconds of gaps that overlap, by when they begin."""


@cache
def real_gaps() -> Mapping[str, Occlusions]:
    """Return the gaps of each file by its name."""
    table = Path(__file__).with_name("real_gaps.csv").read_text(encoding="utf-8")
    found: dict[str, tuple[float, list[tuple[float, ...]]]] = {}
    for row in csv.DictReader(table.splitlines()):
        rate = float(row["rate"])
        gaps = tuple(int(length) / rate for length in row["gaps"].split())
        found.setdefault(row["file"], (int(row["frames"]) / rate, []))[1].append(gaps)
    return found
