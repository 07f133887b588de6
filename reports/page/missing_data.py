"""The recordings that jobs lack, each said once, with the command that gets them."""

from __future__ import annotations

import shlex
from collections.abc import Iterable
from dataclasses import dataclass

from mocapbench.reports.analysis.failures import Failure

__all__ = ["MissingData", "missing_data"]


@dataclass(frozen=True)
class MissingData:
    """Recordings that one command gets.

    Parameters
    ----------
    recordings : tuple of str
        Empty where the jobs do not name them.
    message : str
        How to get them: a command, or what the jobs say.
    tasks : tuple of str
        The tasks concerned.
    jobs : int
        How many jobs lack one or more of them.
    """

    recordings: tuple[str, ...]
    message: str
    tasks: tuple[str, ...]
    jobs: int


def missing_data(jobs: Iterable[Failure]) -> list[MissingData]:
    """Group the jobs that lack data by the command that gets them, whatever the recordings."""
    groups: dict[str, list[Failure]] = {}
    for job in jobs:
        groups.setdefault(job.fetch or job.message, []).append(job)
    return [_group(start, group) for start, group in groups.items()]


def _group(start: str, group: list[Failure]) -> MissingData:
    recordings = tuple(dict.fromkeys(name for job in group for name in job.missing))
    return MissingData(
        recordings,
        f"{start} {shlex.join(recordings)}".strip(),
        tuple(dict.fromkeys(job.task for job in group)),
        len(group),
    )
