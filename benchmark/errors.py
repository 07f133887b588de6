"""Errors of the harness, and the exit codes that the command line turns them into."""

from __future__ import annotations

import difflib
from collections.abc import Collection
from enum import IntEnum

__all__ = ["ExitCode", "UnknownNameError", "UnregisteredNameError", "UsageError", "first_of"]


class ExitCode(IntEnum):
    """What the process's exit code means."""

    OK = 0
    REGRESSION = 1
    USAGE = 2
    JOBS_FAILED = 3
    NOTHING_RAN = 4
    UNDECIDED = 5
    DEFECT = 70
    INTERRUPTED = 130


class UsageError(ValueError):
    """The user asked for something that cannot be done; the message says what to do."""


_MOST_NAMES = 20
"""Known names that a message lists at most."""


def first_of(names: Collection[str], most: int) -> str:
    """Return the first ``most`` names, and how many more there are."""
    more = len(names) - most
    return ", ".join([*names][:most]) + (f" and {more} more" if more > 0 else "")


class UnknownNameError(UsageError):
    """A name that is not known, with the nearest ones that are."""

    def __init__(self, kind: str, name: str, known: Collection[str]) -> None:
        near = difflib.get_close_matches(name, known, n=3, cutoff=0.4)
        advice = (
            f"did you mean {' or '.join(near)}?"
            if near
            else f"known: {first_of(known, _MOST_NAMES)}"
        )
        super().__init__(f"unknown {kind} {name!r}: {advice}")


class UnregisteredNameError(UnknownNameError):
    """A name under which no plug-in is registered; perhaps its file was not named."""

    def __str__(self) -> str:
        remedy = "if a file of your own defines it, name that file with --plugin or --task-file"
        return f"{super().__str__()} ({remedy})"
