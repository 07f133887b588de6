"""Progress of a run: a live bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
)

from mocapbench.benchmark.runs.job import Outcome
from mocapbench.benchmark.runs.record import Record, Status

__all__ = ["in_words", "watch"]

_PLAIN_INTERVAL, _BAR_INTERVAL = 5.0, 1.0
"""Seconds between estimates of the time left, which take a while in a run of many jobs."""


def watch(
    outcomes: Iterable[Outcome], total: int, time_left: Callable[[], float], console: Console
) -> Iterator[Outcome]:
    """Yield ``outcomes`` as they come, showing how many are done, failed and left.

    Parameters
    ----------
    outcomes : iterable of Outcome
    total : int
        How many are expected.
    time_left : callable
        Returns the seconds that the others are expected to take.
    console : rich.console.Console
        Where to show it; a live bar if it is a terminal.
    """
    display = _bar if console.is_terminal else _lines
    yield from display(outcomes, total, time_left, console)


def _bar(
    outcomes: Iterable[Outcome], total: int, time_left: Callable[[], float], console: Console
) -> Iterator[Outcome]:
    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[failed]} failed"),
        TimeElapsedColumn(),
        TextColumn("about {task.fields[left]} left"),
    )
    counts: Counter[Status] = Counter()
    left, due = "…", time.monotonic()
    with Progress(*columns, console=console) as progress:
        bar = progress.add_task("jobs", total=total, failed=0, left=left)
        for outcome in outcomes:
            counts[outcome.record.status] += 1
            if time.monotonic() >= due or counts.total() == total:
                left, due = in_words(time_left()), time.monotonic() + _BAR_INTERVAL
            progress.update(
                bar,
                advance=1,
                failed=_broken(counts),
                left=left,
                description=str(outcome.record.address),
            )
            _announce(outcome.record, console)
            yield outcome


def _lines(
    outcomes: Iterable[Outcome], total: int, time_left: Callable[[], float], console: Console
) -> Iterator[Outcome]:
    counts: Counter[Status] = Counter()
    shown = time.monotonic()
    for outcome in outcomes:
        counts[outcome.record.status] += 1
        _announce(outcome.record, console)
        now, done = time.monotonic(), counts.total()
        if now - shown >= _PLAIN_INTERVAL or done == total:
            console.print(
                f"{done}/{total} jobs done, {_broken(counts)} failed, "
                f"about {in_words(time_left())} left",
                highlight=False,
            )
            shown = now
        yield outcome


def in_words(seconds: float) -> str:
    """Return a duration in the unit that people would name it in."""
    minutes, hours = round(seconds / 60), seconds / 3600
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{minutes} min" if minutes < 90 else f"{hours:.1f} h"


def _announce(record: Record, console: Console) -> None:
    if record.status.broken:
        # Rich's search for what to highlight takes a minute in a word of 50 000 letters.
        tables = f"(fold {record.address.fold} in tables)"
        line = f"{record.status}: {record.address} {tables}: {record.message}"
        console.print(line, markup=False, highlight=False, soft_wrap=True)


def _broken(counts: Counter[Status]) -> int:
    return sum(count for status, count in counts.items() if status.broken)
