"""Temporary files that a killed run left behind."""

from __future__ import annotations

from pathlib import Path

from mocapbench.basics.whole_files import target_of
from mocapbench.benchmark.runs.directory.fit_files import PREDICTIONS
from mocapbench.benchmark.runs.directory.key_file import KEYS
from mocapbench.benchmark.runs.directory.plan_file import PLAN
from mocapbench.benchmark.runs.directory.record_files import RECORDS

__all__ = ["sweep"]

_WRITTEN_UNDER_LOCK = {PLAN, KEYS}
"""Other commands write the other files at the top, at any time."""


def sweep(folder: Path) -> None:
    """Delete what killed runs have not finished, while the caller holds the folder's lock."""
    top = [path for path in folder.glob(".*") if target_of(path) in _WRITTEN_UNDER_LOCK]
    below = [
        path
        for name in (RECORDS, PREDICTIONS)
        for path in (folder / name).rglob(".*")
        if target_of(path)
    ]
    for path in top + below:
        path.unlink()
