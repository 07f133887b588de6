"""The recordings that jobs lack, each said once, with the command that gets them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from mocapbench.reports.analysis.troubles import Trouble

__all__ = ["MissingData", "missing_data"]

MESSAGE = re.compile(r"(?P<names>\S.*) cannot be had: get it with `(?P<command>[^`]+)`")
"""How a job says which recordings it lacks, and the command that gets them."""
NAMES = "{names}"


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


def missing_data(jobs: Iterable[Trouble]) -> list[MissingData]:
    """Group the jobs that lack data by the command that gets them, whatever the recordings."""
    by_command: dict[str, list[tuple[Trouble, tuple[str, ...]]]] = {}
    for job in jobs:
        command, recordings = _parse(job.message)
        by_command.setdefault(command, []).append((job, recordings))
    return [_group(command, group) for command, group in by_command.items()]


def _parse(message: str) -> tuple[str, tuple[str, ...]]:
    """Return the command without the names of the recordings, and the names."""
    match = MESSAGE.fullmatch(message)
    if match is None or match["names"] not in match["command"]:
        return message, ()
    return match["command"].replace(match["names"], NAMES, 1), tuple(match["names"].split())


def _group(command: str, group: list[tuple[Trouble, tuple[str, ...]]]) -> MissingData:
    recordings = tuple(dict.fromkeys(name for _, names in group for name in names))
    return MissingData(
        recordings,
        command.replace(NAMES, " ".join(recordings)) if recordings else command,
        tuple(dict.fromkeys(job.task for job, _ in group)),
        len(group),
    )
