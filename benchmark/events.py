"""Events of a run as they happen: a log for other programs, one JSON object a line."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from mocapbench.benchmark.errors import ExitCode
from mocapbench.benchmark.tasks.address import Address

__all__ = ["EventLog", "event_log"]


def _discard(_: str) -> None:
    """Write to nowhere."""


class EventLog:
    """Turns events into lines.

    Parameters
    ----------
    write : callable
        Takes each line; by default the lines are dropped.
    """

    def __init__(self, write: Callable[[str], object] = _discard) -> None:
        self._write = write
        self._counts: Counter[str] = Counter()

    def tell_run_start(self, folder: Path, jobs: int, in_store: int) -> None:
        """Tell the run directory, how many jobs are planned, and how many it holds already."""
        self._write_event("run-started", out=str(folder), jobs=jobs, in_store=in_store)

    def tell_job_start(self, address: Address) -> None:
        """Tell that a job was handed to a worker."""
        self._write_event("job-started", **address._asdict())

    def tell_job_end(self, address: Address, status: str, seconds: float, message: str) -> None:
        """Tell how a job ended, and after how many seconds of work."""
        self._counts[status] += 1
        outcome = {"status": status, "seconds": round(seconds, 3), "message": message}
        self._write_event("job-ended", **address._asdict(), **outcome)

    def tell_run_end(self, code: ExitCode) -> None:
        """Tell how many jobs of this run ended in which way, and its exit code."""
        self._write_event("run-ended", counts=dict(self._counts), exit_code=int(code))

    def _write_event(self, name: str, **about: Any) -> None:
        now = datetime.now(UTC).isoformat(timespec="milliseconds")
        line = json.dumps({"event": name, "time": now, **about}, allow_nan=False)
        self._write(f"{line}\n")


@contextmanager
def event_log(path: Path | None) -> Iterator[EventLog]:
    """Open a log, to whose file lines are added; without a path, the lines are dropped."""
    if path is None:
        yield EventLog()
        return
    with path.open("a", encoding="ascii", buffering=1) as file:  # flushed line by line
        yield EventLog(file.write)
