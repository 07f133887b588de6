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


def troubles(bundle: Bundle) -> tuple[Trouble, ...]:
    """Return every job without a score, in the order of the records."""
    rows = bundle.records[bundle.records["status"] != "ok"]
    return tuple(
        Trouble(
            id=f"job-{number}",
            fold=int(row["fold"]),
            **{
                field: "" if pd.isna(row[field]) else str(row[field])
                for field in ("task", "case", "label", "status", "message", "traceback")
            },
        )
        for number, row in enumerate(rows.to_dict("records"), start=1)
    )
