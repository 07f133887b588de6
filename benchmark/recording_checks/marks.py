"""Values that mark missing ones, or may: zeros, held values, and numbers that nothing measures."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd

from mocapbench.basics.arrays import Mask
from mocapbench.basics.mask_runs import run_bounds
from mocapbench.benchmark.missing_values import find_held, find_zeros
from mocapbench.benchmark.recording_checks.findings_table import tabulate_findings
from mocapbench.benchmark.recording_checks.visibility import place_markers
from mocapbench.datasets import Recording

__all__ = ["find_marks"]

Mark = tuple[str, tuple[str, ...], int, int]
"""A kind, the marker, and its frames [start, stop)."""


def find_marks(stated: Recording, missing: Mask) -> pd.DataFrame:
    """Return where markers or channels have values that mark missing ones, or may.

    Parameters
    ----------
    stated : Recording
        N frames of D channels, as the file has them.
    missing : ndarray of bool of shape (N, D)
        Which values are read as missing.

    Returns
    -------
    DataFrame
        A row each with the kind ``zeros`` or ``held``, whether read as missing or not, or
        ``number``, which is.
    """
    rows = [*_list_undecided(stated.hide(missing)), *_list_decided(stated, missing)]
    return tabulate_findings([(*row, np.nan) for row in rows])


def _list_decided(stated: Recording, missing: Mask) -> Iterator[Mark]:
    """Yield what each run of values that are read as missing is, of which marker, and where."""
    for name, places in place_markers(stated):
        values, marked = stated.values[:, places], missing[:, places].all(axis=1)
        zero = (values == 0.0).all(axis=1)
        yield from _list_runs("zeros", name, marked & zero)
        for start, stop in run_bounds(marked & ~zero).tolist():
            held = start > 0 and bool((values[start] == values[start - 1]).all())
            yield "held" if held else "number", (name,), start, stop


def _list_undecided(recording: Recording) -> Iterator[Mark]:
    """Yield runs of zeros and of held values that are not read as missing."""
    for name, frames in find_zeros(recording).items():
        yield from _list_runs("zeros", name, frames)
    for name, start, stop, _ in find_held(recording):
        yield "held", (name,), start, stop


def _list_runs(kind: str, name: str, frames: Mask) -> Iterator[Mark]:
    yield from ((kind, (name,), start, stop) for start, stop in run_bounds(frames).tolist())
