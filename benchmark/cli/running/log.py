"""The log of a run's events, whose last line tells how the run ended, however it ended."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import typer

from mocapbench.benchmark import cli
from mocapbench.benchmark.cli.options import require_writable
from mocapbench.benchmark.errors import ExitCode
from mocapbench.benchmark.events import EventLog, event_log

__all__ = ["require_log", "run_log"]


def require_log(path: Path | None, out: Path) -> None:
    """Refuse a log that cannot be written, before anything is computed.

    Raises
    ------
    UsageError
        If it is in a folder that does not exist, other than the run directory.
    """
    if path is not None and path.parent.resolve() != out.resolve():
        require_writable(path)


@contextmanager
def run_log(path: Path | None) -> Iterator[EventLog]:
    """Open the log of a run that ends with `typer.Exit`, or with an error."""
    with event_log(path) as log:
        try:
            yield log
        except typer.Exit as ended:
            log.tell_run_end(ExitCode(ended.exit_code))
            raise
        except BaseException as error:
            log.tell_run_end(cli.exit_code(error))
            raise
