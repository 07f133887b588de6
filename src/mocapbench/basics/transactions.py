"""Several files of one folder that take their places together.

A file takes its name at once, several do not: a process may be killed between two of them. So they
are first written as drafts, in a folder within that of their places. Renaming the folder of drafts
decides that all of them count; thereafter each takes its place. Whoever finds the renamed folder
moves what is still in it, which ends as if nobody had been killed: a redo log, as databases keep
it, whose entries are the files themselves.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

__all__ = ["decide", "draft_folder", "finish"]

_DRAFTS, _DECIDED = "drafts", "decided"
_OBSOLETE = "obsolete"
"""Has an empty file for each that goes when the others take their places."""


def draft_folder(folder: Path, obsolete: Iterable[str] = ()) -> Path:
    """Return a new folder of drafts within ``folder``.

    Parameters
    ----------
    folder : Path
        A new folder, within that of the files.
    obsolete : iterable of str
        The names of files that are deleted when the others take their places.
    """
    marks = folder / _OBSOLETE
    marks.mkdir()
    for name in obsolete:
        (marks / name).touch()
    drafts = folder / _DRAFTS
    drafts.mkdir()
    return drafts


def decide(folder: Path) -> None:
    """Have all drafts of a folder count from now on, whatever happens to this process."""
    (folder / _DRAFTS).rename(folder / _DECIDED)


def finish(folder: Path) -> None:
    """Move drafts that count, if there are any, to their places beside ``folder``."""
    decided = folder / _DECIDED
    if not _is_own_folder(decided):
        return
    for name in _list_names(folder / _OBSOLETE):
        (folder.parent / name).unlink(missing_ok=True)
    for name in _list_names(decided):
        (decided / name).replace(folder.parent / name)


def _list_names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir()) if _is_own_folder(folder) else []


def _is_own_folder(path: Path) -> bool:
    """Return whether there is such a folder; a link, which somebody sent, may lead anywhere."""
    return path.is_dir() and not path.is_symlink()
