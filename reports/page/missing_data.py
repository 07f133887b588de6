"""The jobs that lack recordings, grouped by what the user can do about it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from mocapbench.reports.analysis.troubles import Trouble

__all__ = ["MissingData", "missing_data"]


@dataclass(frozen=True)
class MissingData:
    """Jobs that lack the same data.

    Parameters
    ----------
    message : str
        How to get the data.
    cases : tuple of str
        The cases concerned, with their tasks.
    jobs : int
        How many jobs.
    """

    message: str
    cases: tuple[str, ...]
    jobs: int


def missing_data(jobs: Iterable[Trouble]) -> list[MissingData]:
    """Group the jobs that lack data by their message."""
    by_message: dict[str, list[Trouble]] = {}
    for job in jobs:
        by_message.setdefault(job.message, []).append(job)
    return [
        MissingData(
            message, tuple(dict.fromkeys(f"{job.task}: {job.case}" for job in group)), len(group)
        )
        for message, group in by_message.items()
    ]
