"""A user's own Python file of models, tasks, metrics, libraries and formats, for one run."""

from __future__ import annotations

import hashlib
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import ModuleType
from typing import Any

from mocapbench.baselines import Model
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.messages import reason
from mocapbench.benchmark.registry import FORMATS, LIBRARIES, METRICS, MODELS, TASKS, Registry
from mocapbench.benchmark.tasks.base import Task
from mocapbench.datasets import Format, Library
from mocapbench.metrics import Metric

__all__ = ["load_plugin"]


@dataclass(frozen=True)
class _PluginKind:
    """What a file may define under one name: a mapping from names to values of one kind.

    Parameters
    ----------
    registry : Registry
        Where they are registered.
    expected : str
        What the values are.
    fits : callable
        Whether a value is of the kind.
    arguments : tuple
        With which a class of the kind is built.
    built : str
        The same in words.
    """

    registry: Registry[Any]
    expected: str
    fits: Callable[[object], bool]
    arguments: tuple[object, ...] = ()
    built: str = "without arguments"


def _subclass_of(kind: type) -> Callable[[object], bool]:
    return lambda value: isinstance(value, type) and issubclass(value, kind)


def _instance_of(kind: type) -> Callable[[object], bool]:
    return lambda value: isinstance(value, kind)


_PLUGIN_KINDS: Mapping[str, _PluginKind] = {
    "MODELS": _PluginKind(MODELS, "subclasses of mocapbench.baselines.Model", _subclass_of(Model)),
    "TASKS": _PluginKind(TASKS, "mocapbench.benchmark.Task objects", _instance_of(Task)),
    "METRICS": _PluginKind(METRICS, "mocapbench.metrics.Metric objects", _instance_of(Metric)),
    "LIBRARIES": _PluginKind(
        LIBRARIES,
        "subclasses of mocapbench.datasets.Library",
        _subclass_of(Library),
        arguments=(None,),  # no folder of recordings is named
        built="with one argument, a folder of recordings or None",
    ),
    "FORMATS": _PluginKind(
        FORMATS, "subclasses of mocapbench.datasets.Format", _subclass_of(Format)
    ),
}


def load_plugin(path: Path) -> tuple[str, ...]:
    """Register what a Python file defines.

    Parameters
    ----------
    path : Path
        A file that defines one or more of ``MODELS = {"name": ModelClass}``,
        ``TASKS = {"name": task}``, ``METRICS = {"name": metric}``,
        ``LIBRARIES = {"name": LibraryClass}`` and ``FORMATS = {"name": FormatClass}``.

    Returns
    -------
    tuple of str
        The names registered.

    Raises
    ------
    UsageError
        If the file cannot be run, defines none of these, or something else under their names.
    """
    module = _execute(path)
    defined = {
        name: value
        for name, value in vars(module).items()
        if name in _PLUGIN_KINDS and not isinstance(value, Registry)  # ours, which it may import
    }
    if not defined:
        raise UsageError(
            f"{path}: expected one or more of {', '.join(_PLUGIN_KINDS)}, each a mapping such as "
            'MODELS = {"name": ModelClass}, got none'
        )
    for attribute, values in defined.items():
        _check(path, attribute, values)
    for attribute, values in defined.items():
        for name, value in values.items():
            _PLUGIN_KINDS[attribute].registry.add(name, value)
    return tuple(name for values in defined.values() for name in values)


def _check(path: Path, attribute: str, values: object) -> None:
    kind = _PLUGIN_KINDS[attribute]
    if not (isinstance(values, dict) and values and all(map(kind.fits, values.values()))):
        raise UsageError(
            f"{path}: expected {attribute} to map one or more names to {kind.expected}, got "
            f'{values!r}; write {attribute} = {{"name": …}}'
        )
    for name, value in values.items():
        _check_name(path, kind.registry, name, value)
        _check_constructor(path, name, value, kind)


def _check_name(path: Path, registry: Registry[Any], name: object, value: Any) -> None:
    """Refuse a name that stands for something else already, and what cannot be used under it."""
    tasks = map(TASKS.get, TASKS.names())
    entrants = (entrant for task in tasks for entrant in task.entrants)
    others = {entrant.label for entrant in entrants if entrant.model != name}
    taken = registry is MODELS and name in others
    if not isinstance(name, str) or taken or registry.is_installed(name):
        raise UsageError(
            f"{path}: expected a name that no {registry.kind} or entrant has, got {name!r}; "
            "choose another"
        )
    if not isinstance(value, type) and value.name != name:
        raise UsageError(
            f"{path}: expected the {registry.kind} under its own name {value.name!r}, got "
            f"{name!r}; rename one of the two"
        )


def _check_constructor(path: Path, name: str, value: object, kind: _PluginKind) -> None:
    if not isinstance(value, type):
        return
    try:
        value(*kind.arguments)
    except Exception as error:
        raise UsageError(
            f"{path}: expected a class that can be built {kind.built}, got {name!r}: "
            f"{reason(error)}; give every other parameter a default, and define abstract methods"
        ) from error


def _execute(path: Path) -> ModuleType:
    """Run a Python file as a module whose name follows from its content."""
    if not path.is_file():
        what = "is a folder" if path.is_dir() else "does not exist"
        raise UsageError(
            f"--plugin: expected a Python file, got {str(path)!r}, which {what}; check the path"
        )
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
