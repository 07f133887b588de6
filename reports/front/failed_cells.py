"""The cells of models that failed wherever they were tried in a task, and so have no mean."""

from __future__ import annotations

import math
from collections.abc import Container, Mapping

from mocapbench.reports.analysis.failures import DATA_MISSING, Failure
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.front.board import FAILED, BoardCell

__all__ = ["failed_cells"]


def failed_cells(results: TaskResults, scored: Container[str]) -> Mapping[str, BoardCell]:
    """Return a cell for each label that failed and has no mean, which leads to a failure.

    Parameters
    ----------
    results : TaskResults
    scored : container of str
        The labels that have a mean.
    """
    by_label: dict[str, list[Failure]] = {}
    for (_, label), failures in results.failures.items():
        failed = [failure for failure in failures if failure.status != DATA_MISSING]
        if failed and label not in scored:
            by_label.setdefault(label, []).extend(failed)
    tried = results.records[results.records["status"] != DATA_MISSING]["label"].value_counts()
    return {label: _cell(failed, int(tried[label])) for label, failed in by_label.items()}


def _cell(failed: list[Failure], n_jobs: int) -> BoardCell:
    note = f"in {len(failed)} of {n_jobs}"
    return BoardCell(FAILED, math.nan, FAILED, link=failed[0].id, note=note)
