"""Whether the report in a run directory shows what a run found, so that it need not be drawn."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.runs.source_code.folders import folders_digest
from mocapbench.benchmark.task_files.task_file import TaskFile

__all__ = ["digest_code", "last_drawn", "stamp"]

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


def last_drawn(store: RunDirectory, keys: Sequence[str]) -> str:
    """Return the stamp of the report there; an empty string unless the last run had these jobs."""
    try:
        plan = store.load_plan()
    except UsageError:  # no run got so far
        return ""
    there = plan["keys"] == list(keys) and (store.path / "report.html").is_file()
    return str(plan.get("drawn", "")) if there else ""
