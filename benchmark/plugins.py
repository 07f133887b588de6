"""A user's own file for one run: Python with plug-ins of any kind, or the TOML of a command."""

from __future__ import annotations

import hashlib
import sys
from collections.abc import Iterable, Mapping
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import ModuleType
from typing import Any

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.messages import reason
from mocapbench.benchmark.plugin_kinds import PLUGIN_KINDS, check_definition
from mocapbench.benchmark.programs.declaration import define_models, is_declaration
from mocapbench.benchmark.registry import Registry

__all__ = ["load_plugin", "load_plugins"]

Definitions = Mapping[str, Mapping[str, Any]]
"""The values of a file by name, by the name of their kind."""


def load_plugins(paths: Iterable[Path]) -> None:
    """Register what several files define.

    Parameters
    ----------
    paths : iterable of Path
        See `load_plugin`.

    Raises
    ------
    UsageError
        If two of them define the same name, or one of them is refused by itself.
    """
    files: dict[tuple[str, str], Path] = {}
    for path in dict.fromkeys(paths):
        defined = _definitions(path)
        for place in ((attribute, name) for attribute in defined for name in defined[attribute]):
            _require_only_one(files.setdefault(place, path), path, *place)
        _register(defined)


def _require_only_one(first: Path, path: Path, attribute: str, name: str) -> None:
    if first != path:
        raise UsageError(
            f"{path}: expected a {PLUGIN_KINDS[attribute].registry.kind} under a name that no "
            f"other --plugin defines, got {name!r}, which {first} defines too; rename one of the "
            "two, or leave one file out"
        )


def load_plugin(path: Path) -> tuple[str, ...]:
    """Register what a file defines.

    Parameters
    ----------
    path : Path
        The TOML file of a model that is a command, or a Python file that defines one or more of
        ``MODELS = {"name": ModelClass}``, ``TASKS = {"name": task}``,
        ``METRICS = {"name": metric}``, ``LIBRARIES = {"name": LibraryClass}`` and
        ``FORMATS = {"name": FormatClass}``.

    Returns
    -------
    tuple of str
        The names registered.

    Raises
    ------
    UsageError
        If the file cannot be run, defines none of these, or something else under their names.
    """
    defined = _definitions(path)
    _register(defined)
    return tuple(name for values in defined.values() for name in values)


def _definitions(path: Path) -> Definitions:
    """Return what a file defines, once it is known to be usable."""
    _require_file(path)
    defined = {"MODELS": define_models(path)} if is_declaration(path) else _execute(path)
    for attribute, values in defined.items():
        check_definition(path, attribute, values)
    return defined


def _register(defined: Definitions) -> None:
    for attribute, values in defined.items():
        for name, value in values.items():
            PLUGIN_KINDS[attribute].registry.add(name, value)


def _require_file(path: Path) -> None:
    if not path.is_file():
        what = "is a folder" if path.is_dir() else "does not exist"
        raise UsageError(
            f"--plugin: expected a Python file, or the TOML file of a command, got {str(path)!r}, "
            f"which {what}; check the path"
        )


def _execute(path: Path) -> Definitions:
    """Return what a Python file defines under the names of kinds."""
    defined = {
        name: value
        for name, value in vars(_load_module(path)).items()
        if name in PLUGIN_KINDS and not isinstance(value, Registry)  # ours, which it may import
    }
    if not defined:
        raise UsageError(
            f"{path}: expected one or more of {', '.join(PLUGIN_KINDS)}, each a mapping such as "
            'MODELS = {"name": ModelClass}, got none'
        )
    return defined


def _load_module(path: Path) -> ModuleType:
    """Run a Python file as a module whose name follows from its content."""
    file, search_path = path.resolve(), [*sys.path]
    name = f"mocapbench_plugin_{hashlib.sha256(file.read_bytes()).hexdigest()[:16]}"
    module = ModuleType(name)
    module.__file__ = str(file)
    sys.modules[name] = module  # where pickle and the source digest look for it
    sys.path.append(str(file.parent))  # so that the file can import helpers that lie beside it
    try:
        SourceFileLoader(name, str(file)).exec_module(module)
    except (Exception, SystemExit) as error:
        del sys.modules[name]
        sys.path[:] = search_path
        raise UsageError(
            f"{path} cannot be run: {reason(error)}; `python {path}` shows where"
        ) from error
    return module
