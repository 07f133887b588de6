"""The jobs that gave no score, or none of some metric."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from mocapbench.reports.bundle.bundle import Bundle

__all__ = ["DATA_MISSING", "Trouble", "troubles"]

DATA_MISSING = "data-missing"


@dataclass(frozen=True)
class Trouble:
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
    """

    id: str
    task: str
    case: str
    fold: int
    label: str
    status: str
    message: str
    traceback: str


FIELDS = ("task", "case", "label", "status", "message", "traceback")


def troubles(bundle: Bundle, task: str | None = None) -> tuple[Trouble, ...]:
    """Return the jobs that did not end well, of one task or all, in the order of the records."""
    lost = bundle.records["status"].to_numpy() != "ok"
    wanted = lost if task is None else lost & (bundle.records["task"].to_numpy() == task)
    rows = bundle.records.loc[wanted, ["fold", *FIELDS]].assign(number=np.cumsum(lost)[wanted])
    return tuple(
        Trouble(
            id=f"job-{row['number']}",
            fold=int(row["fold"]),
            **{field: "" if pd.isna(row[field]) else str(row[field]) for field in FIELDS},
        )
        for row in rows.to_dict("records")
    )
