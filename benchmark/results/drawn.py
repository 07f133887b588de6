"""Whether the report in a run directory shows what a run found, so that it need not be drawn."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.runs.source_code.folders import folders_digest
from mocapbench.benchmark.task_files.task_file import TaskFile

__all__ = ["digest_code", "last_drawn", "mark_drawn", "read_stamp", "stamp"]

_PARTS = ("basics", "datasets", "metrics", "baselines", "reports", "benchmark")


def stamp(
    records: Sequence[Record], plugins: Sequence[Path] = (), task_files: Sequence[TaskFile] = ()
) -> str:
    """Return a digest of what a report shows and what draws it.

    Parameters
    ----------
    records : sequence of Record
    plugins : sequence of Path
        The user's own files, whose tasks have texts of their own.
    task_files : sequence of TaskFile
        Of which every text counts.
    """
    digest = hashlib.sha256(digest_code().encode())
    for text in (*(path.read_bytes() for path in plugins), *(f.text.encode() for f in task_files)):
        digest.update(hashlib.sha256(text).digest())
    for record in records:
        digest.update(record.to_json().encode())
    return digest.hexdigest()


@cache
def digest_code() -> str:
    """Return a digest of our code, templates, styles and published values."""
    return folders_digest(_PARTS)


def mark_drawn(stamp: str, page: Path) -> str:
    """Return what the plan keeps of a report: its stamp, and a digest of the page."""
    return f"{stamp} {hashlib.sha256(page.read_bytes()).hexdigest()}"


def last_drawn(store: RunDirectory, keys: Sequence[str]) -> str:
    """Return the stamp of the report there; an empty string unless the last run had these jobs."""
    try:
        plan = store.load_plan()
    except UsageError:  # no run got so far
        return ""
    return read_stamp(store, plan) if plan["keys"] == list(keys) else ""


def read_stamp(store: RunDirectory, plan: Mapping[str, Any]) -> str:
    """Return the stamp of the report that a plan tells of; empty if it is gone or was changed."""
    drawn, page = str(plan.get("drawn", "")), store.path / "report.html"
    stamp, _, _ = drawn.partition(" ")
    return stamp if page.is_file() and mark_drawn(stamp, page) == drawn else ""
