"""Errors of the harness, and the exit codes that the command line turns them into."""

from __future__ import annotations

import difflib
import errno
from collections.abc import Collection
from enum import IntEnum

from mocapbench.basics.words import join_names

__all__ = [
    "ExitCode",
    "Interruption",
    "OutputError",
    "UnknownNameError",
    "UnregisteredNameError",
    "UsageError",
]


class ExitCode(IntEnum):
    """What the process's exit code means; from 128 on, it is 128 and the number of a signal."""

    OK = 0
    REGRESSION = 1
    USAGE = 2
    JOBS_FAILED = 3
    NOTHING_RAN = 4
    UNDECIDED = 5
    NOT_REPEATABLE = 6
    DEFECT = 70
    HUNG_UP = 129
    INTERRUPTED = 130
    CLOSED_PIPE = 141
    TERMINATED = 143


class Interruption(KeyboardInterrupt):
    """A signal that ends the process, which winds up first.

    Parameters
    ----------
    number : int
        The signal's.
    """

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.exit_code: ExitCode = ExitCode(128 + number)


class OutputError(SystemExit):
    """Standard output or error that cannot be written to.

    Parameters
    ----------
    stream : str
        What it is called.
    error : OSError
        What the system says.
    """

    def __init__(self, stream: str, error: OSError) -> None:
        self.exit_code: ExitCode = _CODES_OF_OUTPUT.get(error.errno or 0, ExitCode.USAGE)
        super().__init__(int(self.exit_code))
        self._message = f"error: cannot write to {stream}: {error.strerror}; make room for it\n"

    def __str__(self) -> str:
        """Return what to say of it; nothing where the reader has left."""
        return self._message if self.exit_code is ExitCode.USAGE else ""


_CODES_OF_OUTPUT = {errno.EPIPE: ExitCode.CLOSED_PIPE, errno.EIO: ExitCode.HUNG_UP}
"""The reader of a pipe has left, or the terminal is gone; of other errors people are to hear."""


class UsageError(ValueError):
    """The user asked for something that cannot be done; the message says what to do."""


_MOST_NAMES = 20
"""Known names that a message lists at most."""


class UnknownNameError(UsageError):
    """A name that is not known, with the nearest ones that are."""

    def __init__(self, kind: str, name: str, known: Collection[str]) -> None:
        near = difflib.get_close_matches(name, known, n=3, cutoff=0.4)
        advice = (
            f"did you mean {' or '.join(near)}?"
            if near
            else f"known: {join_names(known, _MOST_NAMES)}"
        )
        super().__init__(f"unknown {kind} {name!r}: {advice}")


class UnregisteredNameError(UnknownNameError):
    """A name under which no plug-in is registered; perhaps its file was not named."""

    def __str__(self) -> str:
        remedy = "if a file of your own defines it, name that file with --plugin or --task-file"
        return f"{super().__str__()} ({remedy})"
