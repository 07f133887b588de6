"""Whether the report in a run directory shows what a run found, so that it need not be drawn."""

from __future__ import annotations

import hashlib
import importlib
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.runs.store import Store
from mocapbench.benchmark.task_files.task_file import TaskFile

__all__ = ["last_drawn", "stamp"]

_PARTS = ("datasets", "metrics", "baselines", "reports", "benchmark")


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
    digest = hashlib.sha256(_drawing_code())
    for text in (*(path.read_bytes() for path in plugins), *(f.text.encode() for f in task_files)):
        digest.update(hashlib.sha256(text).digest())
    for record in records:
        digest.update(record.to_json().encode())
    return digest.hexdigest()


@cache
def _drawing_code() -> bytes:
    """Return a digest of our code, templates, styles and published values."""
    digest = hashlib.sha256()
    for part in _PARTS:
        (folder,) = importlib.import_module(f"mocapbench.{part}").__path__
        for path in _files(Path(folder)):
            digest.update(path.relative_to(folder).as_posix().encode())
            digest.update(path.read_bytes())
    return digest.digest()


def _files(folder: Path) -> Iterator[Path]:
    """Yield the files that a package was installed with, in a fixed order."""
    for path in sorted(folder.rglob("*")):
        if path.is_file() and "__pycache__" not in path.parts:
            yield path


def last_drawn(store: Store, keys: Sequence[str]) -> str:
    """Return the stamp of the report there; an empty string unless the last run had these jobs."""
    try:
        plan = store.load_plan()
    except UsageError:  # no run got so far
        return ""
    there = plan["keys"] == list(keys) and (store.path / "report.html").is_file()
    return str(plan.get("drawn", "")) if there else ""
