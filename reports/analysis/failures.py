"""The jobs that gave no score, or none of some metric."""

from __future__ import annotations

import shlex
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from mocapbench.reports.bundle.bundle import Bundle

__all__ = ["DATA_MISSING", "Failure", "list_failures"]

DATA_MISSING = "data-missing"


@dataclass(frozen=True)
class Failure:
    """A job that did not end well; if only a metric failed, it has the scores of the others.

    Parameters
    ----------
    id : str
        Anchor of its entry on the page.
    task, case : str
    fold : int
    label : str
    status : str
        How it ended: any status but ``"ok"``.
    message, traceback : str
    missing : tuple of str
        Names of the recordings that it lacked, where that is known.
    fetch : str
        The command that gets them, up to their names.
    """

    id: str
    task: str
    case: str
    fold: int
    label: str
    status: str
    message: str
    traceback: str
    missing: tuple[str, ...] = ()
    fetch: str = ""


FIELDS = ("task", "case", "label", "status", "message", "traceback", "fetch")


def list_failures(bundle: Bundle, task: str | None = None) -> tuple[Failure, ...]:
    """Return the jobs that did not end well, of one task or all, in the order of the records."""
    lost = bundle.records["status"].to_numpy() != "ok"
    wanted = lost if task is None else lost & (bundle.records["task"].to_numpy() == task)
    rows = bundle.records[wanted].reindex(columns=["fold", "missing", *FIELDS])
    return tuple(
        Failure(
            id=f"job-{number}",
            fold=int(row["fold"]),
            missing=tuple(shlex.split(_text(row["missing"]))),
            **{field: _text(row[field]) for field in FIELDS},
        )
        for number, row in zip(np.cumsum(lost)[wanted], rows.to_dict("records"), strict=True)
    )


def _text(cell: Any) -> str:
    return "" if pd.isna(cell) else str(cell)
