"""Whether the report in a run directory shows what a run found, so that it need not be drawn."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.runs.store import Store
from mocapbench.benchmark.task_files.task_file import TaskFile

__all__ = ["last_drawn", "stamp"]

_DRAWN_BY = ("mocapbench version", "commit", "platform")


def stamp(
    records: Sequence[Record], about: Mapping[str, str], task_files: Sequence[TaskFile] = ()
) -> str:
    """Return a digest of what a report shows, texts of task files included, and what draws it."""
    drawn_by = [*(about.get(name) for name in _DRAWN_BY), *(file.text for file in task_files)]
    digest = hashlib.sha256(json.dumps(drawn_by).encode())
    for record in records:
        digest.update(record.to_json().encode())
    return digest.hexdigest()


def last_drawn(store: Store, keys: Sequence[str]) -> str:
    """Return the stamp of the report there; an empty string unless the last run had these jobs."""
    try:
        plan = store.load_plan()
    except UsageError:  # no run got so far
        return ""
    there = plan["keys"] == list(keys) and (store.path / "report.html").is_file()
    return str(plan.get("drawn", "")) if there else ""
