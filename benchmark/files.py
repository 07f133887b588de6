"""Names of files, folders to write to, and what errors of the system say."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from pathlib import Path, PurePosixPath, PureWindowsPath

from mocapbench.basics.whole_files import LONGEST_NAME
from mocapbench.benchmark.errors import UsageError

__all__ = [
    "ENTRIES",
    "GAPS",
    "is_file_name",
    "is_path_below",
    "is_writable",
    "require_short_names",
    "require_writable_folder",
    "words_of",
]

ENTRIES = ".entries.csv"
"""How the name of a table of filled entries ends, which `mocapbench fill` writes beside a file."""
GAPS = ".gaps.csv"
"""How the name of its table of gaps ends."""
_DEVICE = re.compile(r"(?i)(con|prn|aux|nul|(com|lpt)[0-9¹²³]) *(\..*)?")
"""What Windows takes as the name of a device, in every folder, whatever its suffix."""
_FILE_NAME = re.compile(r"""[^\x00-\x1f"*/:<>?\\|]*[^\x00-\x1f"*/:<>?\\|. ]""")
"""What Windows takes as the name of a file, from whose end it drops dots and spaces."""


def is_file_name(name: str) -> bool:
    r"""Return whether every system takes a text as the name of a file.

    Examples
    --------
    >>> from mocapbench.benchmark.files import is_file_name
    >>> [is_file_name(name) for name in ("walk.csv", "aux.csv", r"day\walk.csv", "walk.")]
    [True, False, False, False]
    """
    return bool(_FILE_NAME.fullmatch(name)) and not _DEVICE.fullmatch(name)


def is_path_below(path: str) -> bool:
    r"""Return whether a path stays below a folder, also where backslashes separate folders.

    Examples
    --------
    >>> from mocapbench.benchmark.files import is_path_below
    >>> [is_path_below(path) for path in ("day/walk.csv", r"..\walk.csv", r"\\server\walk.csv")]
    [True, False, False]
    """
    kinds = PurePosixPath(path), PureWindowsPath(path)
    return not any(kind.anchor or ".." in kind.parts for kind in kinds)


def is_writable(folder: Path) -> bool:
    """Return whether files can be made in ``folder``, or the folder itself where there is none."""
    present = next(path for path in (folder, *folder.absolute().parents) if path.exists())
    return present.is_dir() and os.access(present, os.W_OK | os.X_OK)


def require_writable_folder(option: str, folder: Path) -> None:
    """Refuse the folder that an option of the command line asks to write to.

    Raises
    ------
    UsageError
        If files cannot be made there.
    """
    if not is_writable(folder):
        raise UsageError(
            f"{option}: expected a folder that can be written to, got {folder}; "
            "name another, or change its permissions"
        )


def require_short_names(option: str, paths: Iterable[Path]) -> None:
    """Refuse files whose names are too long to be written, whole or in part.

    Raises
    ------
    UsageError
        If one is.
    """
    for path in paths:
        length = len(os.fsencode(path.name))
        if length > LONGEST_NAME:
            raise UsageError(
                f"{option}: expected files whose names have at most {LONGEST_NAME} bytes, got "
                f"{length} in {path.name}; give the recording a shorter name"
            )


def words_of(error: OSError) -> str:
    """Return what an error of the system says, without its number, and of which file."""
    said = error.strerror or str(error) or type(error).__name__
    if not isinstance(error.filename, str):
        return said
    return f"{error.filename}: {said}"
