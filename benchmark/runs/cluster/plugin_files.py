"""The user's own Python files, as they travel to workers that do not share a disk."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple, Self

__all__ = ["PluginFiles"]


class PluginFiles(NamedTuple):
    """Plug-in files and the helpers that lie beside them, by folder.

    Files of one folder stay together, and keep their names, so that they find each other.
    """

    folders: tuple[Mapping[str, bytes], ...]
    """What each folder holds: contents by name."""
    plugins: tuple[tuple[int, str], ...]
    """The plug-ins: the index of the folder, and the name."""

    @classmethod
    def read(cls, plugins: Sequence[Path]) -> Self:
        """Return plug-ins that this process has loaded, with the helpers that they import.

        Parameters
        ----------
        plugins : sequence of Path
            Full paths.
        """
        parents = list(dict.fromkeys(path.parent for path in plugins))
        folders = tuple(
            {
                path.name: path.read_bytes()
                for path in (*plugins, *_helpers(parent))
                if path.parent == parent
            }
            for parent in parents
        )
        return cls(folders, tuple((parents.index(path.parent), path.name) for path in plugins))

    def write(self, folder: Path) -> tuple[Path, ...]:
        """Write all files below ``folder``, and return the paths of the plug-ins there."""
        for index, files in enumerate(self.folders):
            (folder / str(index)).mkdir(parents=True)
            for name, content in files.items():
                (folder / str(index) / name).write_bytes(content)
        return tuple(folder / str(index) / name for index, name in self.plugins)


def _helpers(folder: Path) -> Iterator[Path]:
    """Yield the single files in ``folder`` that are imported as modules: keys cover the same."""
    for name, module in tuple(sys.modules.items()):
        file = getattr(module, "__file__", None)
        if file and "." not in name and Path(file).resolve().parent == folder:
            yield Path(file).resolve()
