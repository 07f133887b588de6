"""The marker of a run directory: by it a folder of ours is told from one of other things."""

from __future__ import annotations

import json
from pathlib import Path

from mocapbench.basics.whole_files import write_text
from mocapbench.benchmark.errors import UsageError

__all__ = ["is_run", "mark", "require_run", "require_usable"]

_MARKER = "mocapbench.json"
_FORMAT = 1


def is_run(path: Path) -> bool:
    """Return whether ``path`` is a run directory."""
    return (path / _MARKER).is_file()


def mark(path: Path) -> None:
    """Make a folder a run directory, if it is none yet."""
    if not is_run(path):
        write_text(path / _MARKER, json.dumps({"format": _FORMAT}))


def require_run(path: Path) -> None:
    """Refuse what is not a run directory.

    Raises
    ------
    UsageError
        If it is not.
    """
    if not is_run(path):
        raise UsageError(
            f"{path} is not a mocapbench run (there is no {_MARKER} in it); "
            "name the folder that `mocapbench run --out` wrote"
        )


def require_usable(path: Path) -> None:
    """Refuse a folder of other things.

    Raises
    ------
    UsageError
        If ``path`` is a file, or a folder that holds anything but a run.
    """
    if path.exists() and not path.is_dir():
        raise UsageError(f"--out: expected a folder, got the file {path}; name another folder")
    if path.is_dir() and any(path.iterdir()) and not is_run(path):
        raise UsageError(
            f"--out: {path} holds files that are not a mocapbench run (there is no {_MARKER} "
            "in it); name a new or empty folder"
        )
