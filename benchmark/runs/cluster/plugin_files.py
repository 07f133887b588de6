"""The user's own Python files, as they travel to workers that do not share a disk.

Files of one folder stay together, and keep their names, so that they find each other.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

__all__ = ["read_plugin_files", "write_plugin_files"]


def read_plugin_files(plugins: Sequence[Path]) -> dict[str, bytes]:
    """Return plug-ins that this process has loaded, and the helpers beside them that they import.

    Parameters
    ----------
    plugins : sequence of Path
        Full paths.

    Returns
    -------
    dict of str to bytes
        By paths below a folder of the worker.
    """
    helpers = (path for parent in _list_parents(plugins) for path in _helpers(parent))
    every = dict.fromkeys([*plugins, *helpers])
    return {_shorten_path(path, plugins): path.read_bytes() for path in every}


def write_plugin_files(
    files: Mapping[str, bytes], plugins: Sequence[Path], folder: Path
) -> tuple[Path, ...]:
    """Write all files below ``folder``, and return the paths of the plug-ins there.

    Parameters
    ----------
    files : mapping of str to bytes
        What `read_plugin_files` returned.
    plugins : sequence of Path
        What it was given.
    folder : Path
    """
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
    return tuple(folder / _shorten_path(path, plugins) for path in plugins)


def _list_parents(plugins: Sequence[Path]) -> list[Path]:
    return list(dict.fromkeys(path.parent for path in plugins))


def _shorten_path(path: Path, plugins: Sequence[Path]) -> str:
    """Return the path of a file beside a plug-in, with the number of its folder."""
    return f"{_list_parents(plugins).index(path.parent)}/{path.name}"


def _helpers(folder: Path) -> Iterator[Path]:
    """Yield the single files in ``folder`` that are imported as modules: keys cover the same."""
    for name, module in tuple(sys.modules.items()):
        file = getattr(module, "__file__", None)
        if file and "." not in name and Path(file).resolve().parent == folder:
            yield Path(file).resolve()
