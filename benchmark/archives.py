"""The archive of every registered library of recordings."""

from __future__ import annotations

from pathlib import Path

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import LIBRARIES
from mocapbench.datasets import Archive

__all__ = ["archive_at"]


def archive_at(data_dir: Path | None) -> Archive:
    """Return the archive of all libraries, each given the folder that the user names.

    Parameters
    ----------
    data_dir : Path or None
        A folder of recordings; None leaves it to each library where to look.

    Raises
    ------
    UsageError
        If ``data_dir`` is not a folder.
    """
    if data_dir is not None and not data_dir.is_dir():
        raise UsageError(
            f"--data-dir: expected an existing folder of recordings, got {str(data_dir)!r}; "
            "name one, or leave the option out to download"
        )
    return Archive({name: LIBRARIES.get(name)(data_dir) for name in LIBRARIES.names()})
