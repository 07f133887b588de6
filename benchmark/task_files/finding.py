"""Which recordings a task file names, among the files of a folder."""

from __future__ import annotations

from pathlib import Path

from mocapbench.basics.temporaries import final_place
from mocapbench.basics.words import join_names
from mocapbench.benchmark.files import ENTRIES, GAPS
from mocapbench.benchmark.registry import FORMATS
from mocapbench.benchmark.task_files.document import Document
from mocapbench.benchmark.task_files.settings import NONE, OTHERS, Settings

__all__ = ["find_tests", "find_training", "readable_files"]

_SHOWN = 6


def find_tests(document: Document, settings: Settings, folder: Path) -> tuple[str, ...]:
    """Return the paths of the recordings to fill, below ``folder``.

    Raises
    ------
    TaskFileError
        If a pattern matches no file.
    """
    return _matching(document, "files", settings.files, folder)


def find_training(
    document: Document, settings: Settings, tests: tuple[str, ...], folder: Path
) -> tuple[str, ...]:
    """Return the paths of the recordings that models learn from besides the one to fill.

    Raises
    ------
    TaskFileError
        If a pattern matches no file.
    """
    match settings.training:
        case (str(word),) if word == NONE:
            return ()
        case (str(word),) if word == OTHERS:
            return tests
        case patterns:
            return _matching(document, "training", patterns, folder)


def readable_files(folder: Path) -> tuple[str, ...]:
    """Return the paths of all files below ``folder`` that have a registered suffix, in order."""
    suffixes = {suffix for name in FORMATS.names() for suffix in FORMATS.get(name).suffixes}
    files = (path for path in sorted(folder.rglob("*")) if path.suffix.lower() in suffixes)
    return tuple(path.relative_to(folder).as_posix() for path in files if _is_recording(path))


def _matching(
    document: Document, key: str, patterns: tuple[str, ...], folder: Path
) -> tuple[str, ...]:
    found = {pattern: _files(pattern, folder) for pattern in patterns}
    for pattern, paths in found.items():
        if not paths:
            there = readable_files(folder)
            holds = f"it holds {join_names(there, _SHOWN)}"
            expected = f"files in {folder} that match {pattern!r}"
            raise document.error(key, expected, "none", f"of recordings {holds}")
    return tuple(dict.fromkeys(path for paths in found.values() for path in paths))


def _files(pattern: str, folder: Path) -> list[str]:
    """Return the paths that match; a task file of Windows has backslashes between folders."""
    found = [*folder.glob(pattern)] or [*folder.glob(pattern.replace("\\", "/"))]
    return [path.relative_to(folder).as_posix() for path in sorted(found) if _is_recording(path)]


def _is_recording(path: Path) -> bool:
    """Return whether a path is a file, and not what `mocapbench fill` has written beside one."""
    whole = final_place(path) == path  # and not a draft of a file that is being filled
    return whole and path.is_file() and not path.name.endswith((ENTRIES, GAPS))
