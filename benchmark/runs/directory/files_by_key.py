"""One file per key, in folders named by the first two digits of the keys.

So none of these folders gets slow to list. Earlier versions wrote without them, which is read too.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

__all__ = ["FilesByKey"]


class FilesByKey(NamedTuple):
    """The files of one kind.

    Parameters
    ----------
    folder : Path
    suffix : str
        How the files' names end, with the dot.
    """

    folder: Path
    suffix: str

    def keys(self) -> set[str]:
        """Return the keys that have a file, whole or damaged."""
        return {path.stem for path in self.folder.rglob(f"[!.]*{self.suffix}")}

    def find(self, key: str) -> Path:
        """Return where the file of ``key`` is, or belongs."""
        path = self._place(key)
        flat = self.folder / path.name
        return path if path.is_file() or not flat.is_file() else flat

    def make_room(self, key: str) -> Path:
        """Return where the file of ``key`` is to be written, in a folder that is there now."""
        path = self._place(key)
        path.parent.mkdir(exist_ok=True)
        return path

    def _place(self, key: str) -> Path:
        return self.folder / key[:2] / f"{key}{self.suffix}"
