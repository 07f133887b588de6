"""The user's own files, as they travel to workers that do not share a disk.

Files of one folder stay together, and keep their names, so that they find each other.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from mocapbench.benchmark.programs.declaration import is_declaration, list_files

__all__ = ["read_plugin_files", "write_plugin_files"]


def read_plugin_files(plugins: Sequence[Path]) -> dict[str, bytes]:
    """Return plug-ins that this process has loaded, with the files that they need.

    Those are the helpers beside them that Python files import, and the files of commands.

    Parameters
    ----------
    plugins : sequence of Path
        Full paths.

    Returns
    -------
    dict of str to bytes
        By paths below a folder of the worker.
    """
    files = dict.fromkeys((path.parent, each) for path in plugins for each in _list_files(path))
    parents = _list_parents(plugins)
    return {
        f"{parents.index(parent)}/{path.relative_to(parent).as_posix()}": path.read_bytes()
        for parent, path in files
    }


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
    parents = _list_parents(plugins)
    return tuple(folder / str(parents.index(path.parent)) / path.name for path in plugins)


def _list_parents(plugins: Sequence[Path]) -> list[Path]:
    return list(dict.fromkeys(path.parent for path in plugins))


def _list_files(plugin: Path) -> Iterator[Path]:
    """Yield a plug-in and the files that it needs."""
    yield plugin
    yield from list_files(plugin) if is_declaration(plugin) else _helpers(plugin.parent)


def _helpers(folder: Path) -> Iterator[Path]:
    """Yield the single files in ``folder`` that are imported as modules: keys cover the same."""
    for name, module in tuple(sys.modules.items()):
        file = getattr(module, "__file__", None)
        if file and "." not in name and Path(file).resolve().parent == folder:
            yield Path(file).resolve()
