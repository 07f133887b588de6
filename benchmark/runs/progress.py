"""Progress of a run: a live bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterable, Iterator

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from mocapbench.benchmark.runs.record import Record, Status

__all__ = ["watch"]

_PLAIN_INTERVAL = 5.0


def watch(records: Iterable[Record], total: int, console: Console) -> Iterator[Record]:
    """Yield ``records`` as they come, showing how many are done, failed and left.

    Parameters
    ----------
    records : iterable of Record
    total : int
        How many are expected.
    console : rich.console.Console
        Where to show it; a live bar if it is a terminal.
    """
    display = _bar if console.is_terminal else _lines
    yield from display(records, total, console)


def _bar(records: Iterable[Record], total: int, console: Console) -> Iterator[Record]:
    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("{task.fields[failed]} failed"),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    counts: Counter[Status] = Counter()
    with Progress(*columns, console=console) as progress:
        bar = progress.add_task("jobs", total=total, failed=0)
        for record in records:
            counts[record.status] += 1
            progress.update(bar, advance=1, failed=_broken(counts), description=str(record.address))
            _announce(record, console)
            yield record


def _lines(records: Iterable[Record], total: int, console: Console) -> Iterator[Record]:
    counts: Counter[Status] = Counter()
    started = shown = time.monotonic()
    for record in records:
        counts[record.status] += 1
        _announce(record, console)
        now, done = time.monotonic(), counts.total()
        if now - shown >= _PLAIN_INTERVAL or done == total:
            left = (now - started) / done * (total - done)
            console.print(
                f"{done}/{total} jobs done, {_broken(counts)} failed, about {left:.0f} s left",
                highlight=False,
            )
            shown = now
        yield record


def _announce(record: Record, console: Console) -> None:
    if record.status.broken:
        console.print(f"{record.status}: {record.address}: {record.message}", markup=False)


def _broken(counts: Counter[Status]) -> int:
    return sum(count for status, count in counts.items() if status.broken)
