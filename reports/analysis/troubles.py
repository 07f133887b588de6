"""The jobs that gave no score."""

from __future__ import annotations

from dataclasses import dataclass

import pandas as pd

from mocapbench.reports.bundle.bundle import Bundle

__all__ = ["DATA_MISSING", "Trouble", "troubles"]

DATA_MISSING = "data-missing"


@dataclass(frozen=True)
class Trouble:
    """A job without a score.

    Parameters
    ----------
    id : str
        Anchor of its entry on the page.
    task, case : str
    fold : int
    label : str
    status : str
        Why there is no score: any status but ``"ok"``.
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
    """Return the jobs without a score, of one task or of all, in the order of the records."""
    rows = bundle.records.loc[bundle.records["status"] != "ok", ["fold", *FIELDS]]
    rows = rows.assign(number=range(1, len(rows) + 1))
    if task is not None:
        rows = rows[rows["task"] == task]
    return tuple(
        Trouble(
            id=f"job-{row['number']}",
            fold=int(row["fold"]),
            **{field: "" if pd.isna(row[field]) else str(row[field]) for field in FIELDS},
        )
        for row in rows.to_dict("records")
    )
