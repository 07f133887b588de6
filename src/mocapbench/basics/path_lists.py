"""Several paths in one text, as options and variables of the environment have them."""

from __future__ import annotations

import os
from pathlib import Path

__all__ = ["folders_of_recordings", "named_folders"]


def named_folders(text: str | None) -> tuple[Path, ...]:
    """Return the folders that an option or a variable names, in the manner of ``PATH``.

    Parameters
    ----------
    text : str or None
        Paths separated by ``os.pathsep``; None names no folder.
    """
    return tuple(Path(part) for part in (text or "").split(os.pathsep) if part)


def folders_of_recordings() -> tuple[Path, ...]:
    """Return the folders that the variable MOCAPBENCH_DATA names."""
    return named_folders(os.environ.get("MOCAPBENCH_DATA"))
