"""What the last lines of a run say."""

from __future__ import annotations

import shlex
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from mocapbench import benchmark as bench
from mocapbench.basics.words import format_count

if TYPE_CHECKING:
    from mocapbench.benchmark import Job, Record
    from mocapbench.datasets import Archive

__all__ = ["downloading", "fetching", "summary", "wall_time", "without_report"]


def summary(records: Sequence[Record]) -> str:
    """Return how many jobs there are, and how many ended in which way."""
    counts = Counter(record.status for record in records)
    ways = ", ".join(f"{counts[status]} {status}" for status in bench.Status if counts[status])
    return f"{format_count(len(records), 'job')}: {ways}"


def fetching(planned: Sequence[Job], archive: Archive, plugins: Sequence[Path]) -> str:
    """Return how a user gets the recordings that jobs lack."""

    def name_command(uris: Sequence[str], those: str) -> str:
        return f"`{bench.fetch_command(uris, plugins)}` gets {those}"

    return bench.explain_fetching(bench.lacking(planned), archive, name_command)


def downloading(planned: Sequence[Job], archive: Archive) -> str:
    """Return which recordings that jobs lack a run downloads, and what becomes of the others."""

    def name_recordings(uris: Sequence[str], those: str) -> str:
        return f"the run downloads {those} first: {' '.join(bench.recording_names(uris))}"

    return bench.explain_fetching(bench.lacking(planned), archive, name_recordings)


def wall_time(seconds: float, records: Sequence[Record], started: str) -> str:
    """Return the seconds of a run, and how many results are of earlier ones."""
    done = (record for record in records if record.status is bench.Status.OK)
    earlier = sum(record.provenance.get("started") != started for record in done)
    are = "is" if earlier == 1 else "are"
    others = f"; {format_count(earlier, 'result')} {are} of an earlier run" if earlier else ""
    return f"{seconds:.0f} s{others}"


def without_report(run: Path, report: Path) -> str:
    """Return how to write a report, and that the one there shows other results."""
    command = f"`mocapbench report --out {shlex.quote(str(run))}`"
    if report.exists():
        return f"{report.resolve()} shows an earlier run; {command} renews it"
    return f"no report was written; {command} writes one"
