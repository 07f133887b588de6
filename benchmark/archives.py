"""The archive of every registered library of recordings."""

from __future__ import annotations

import os
from pathlib import Path

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import LIBRARIES
from mocapbench.datasets import Archive, named_folders

__all__ = ["archive_at", "full_paths"]


def archive_at(data_dir: Path | None) -> Archive:
    """Return the archive of all libraries, each given the folders that the user names.

    Parameters
    ----------
    data_dir : Path or None
        A folder of recordings, or several separated by `os.pathsep`; None leaves it to each
        library where to look.

    Raises
    ------
    UsageError
        If one of them is not a folder.
    """
    for folder in named_folders(data_dir):
        if not folder.is_dir():
            raise UsageError(
                f"--data-dir: expected an existing folder of recordings, got {str(folder)!r}; "
                f"name one, or several separated by {os.pathsep!r}, or leave the option out to "
                "download"
            )
    return Archive({name: LIBRARIES.get(name)(data_dir) for name in LIBRARIES.names()})


def full_paths(data_dir: Path | None) -> Path | None:
    """Return ``data_dir`` with the full path of every folder that it names, for other processes."""
    folders = [str(folder.resolve()) for folder in named_folders(data_dir)]
    return Path(os.pathsep.join(folders)) if folders else None
