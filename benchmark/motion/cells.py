"""Cells: addresses of results such as ``missing-frames/07-01 three-walkers/knn``."""

from __future__ import annotations

import difflib
from collections.abc import Sequence

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.record import Record, Status

__all__ = ["find_cell"]


def find_cell(records: Sequence[Record], cell: str) -> Record:
    """Return the record of a cell.

    Parameters
    ----------
    records : sequence of Record
    cell : str
        ``TASK/CASE/MODEL`` for the first fold that there is, or ``TASK/CASE/MODEL/FOLD``, with
        folds counted from 1. The model is named by the entrant's label.

    Raises
    ------
    UsageError
        If there is no such cell, with the nearest that there are; or if it has no prediction.
    """
    by_name: dict[str, Record] = {}
    for record in sorted(records, key=lambda record: record.address.fold or 0):
        task, _, case, fold, label = record.address
        by_name.setdefault(f"{task}/{case}/{label}", record)
        by_name[f"{task}/{case}/{label}/{(fold or 0) + 1}"] = record
    if cell not in by_name:
        known = [name for name in by_name if name.count("/") == 2] or [*by_name]
        near = difflib.get_close_matches(cell, known, n=3, cutoff=0.4) or known[:1]
        raise UsageError(
            f"unknown cell {cell!r}: expected TASK/CASE/MODEL or TASK/CASE/MODEL/FOLD of the run, "
            f"such as {' or '.join(map(repr, near))}"
        )
    record = by_name[cell]
    if record.status is not Status.OK:
        raise UsageError(
            f"{cell}: expected a job with a prediction, but it ended as {record.status}: "
            f"{record.message}"
        )
    return record
