"""The folders of recordings that a user names, in one text as in ``PATH``."""

from __future__ import annotations

import os
from pathlib import Path

__all__ = ["named_folders"]


def named_folders(text: str | os.PathLike[str] | None) -> tuple[Path, ...]:
    """Return the folders that ``text`` names, separated by `os.pathsep`; None names none."""
    return tuple(Path(part) for part in os.fspath(text or "").split(os.pathsep) if part)
