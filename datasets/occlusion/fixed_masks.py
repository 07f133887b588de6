"""The 150 masks of Kieu 2022, and the error that its authors print for each.

D. H. Kieu and others, *Locally weighted PCA regression to recover missing markers in human motion
data*, PLoS ONE 17(8), 2022, with the repository ``dangkh/LWPCA``.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

__all__ = ["MarkerRun", "fixed_masks", "published_errors"]

MarkerRun = tuple[int, int, int]
"""A marker, counted from 0, its first hidden frame, and the first visible one after it."""


@cache
def _read_rows() -> Sequence[Mapping[str, str]]:
    table = Path(__file__).with_name("fixed_masks.csv").read_text(encoding="utf-8")
    return tuple(csv.DictReader(table.splitlines()))


def fixed_masks(n_markers: int) -> tuple[tuple[MarkerRun, ...], ...]:
    """Return the masks that hide so many of 41 markers in 400 frames: 50 for 3, 6 or 9, else none.

    Parameters
    ----------
    n_markers : int
    """
    return tuple(
        tuple(map(_parse_run, row["runs"].split()))
        for row in _read_rows()
        if row["n_markers"] == str(n_markers)
    )


def published_errors(n_markers: int) -> tuple[float, ...]:
    """Return the mean absolute error that is printed for each of `fixed_masks`, in mm."""
    rows = (row for row in _read_rows() if row["n_markers"] == str(n_markers))
    return tuple(float(row["published_mae"]) for row in rows)


def _parse_run(text: str) -> MarkerRun:
    """Return the run that ``5:26-396`` stands for."""
    marker, _, frames = text.partition(":")
    start, _, stop = frames.partition("-")
    return int(marker), int(start), int(stop)
