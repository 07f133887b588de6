"""What a user's own file may define: values of five kinds, each under a free name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mocapbench.baselines import Model
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.messages import reason
from mocapbench.benchmark.registry import FORMATS, LIBRARIES, METRICS, MODELS, NAME, TASKS, Registry
from mocapbench.benchmark.tasks.base import Task
from mocapbench.datasets import Format, Library
from mocapbench.metrics import Metric

__all__ = ["PLUGIN_KINDS", "PluginKind", "check_definition"]


@dataclass(frozen=True)
class PluginKind:
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


PLUGIN_KINDS: Mapping[str, PluginKind] = {
    "MODELS": PluginKind(MODELS, "subclasses of mocapbench.baselines.Model", _subclass_of(Model)),
    "TASKS": PluginKind(TASKS, "mocapbench.benchmark.Task objects", _instance_of(Task)),
    "METRICS": PluginKind(METRICS, "mocapbench.metrics.Metric objects", _instance_of(Metric)),
    "LIBRARIES": PluginKind(
        LIBRARIES,
        "subclasses of mocapbench.datasets.Library",
        _subclass_of(Library),
        arguments=(Path(), Path()),
        built="with several arguments, each a folder of recordings",
    ),
    "FORMATS": PluginKind(
        FORMATS, "subclasses of mocapbench.datasets.Format", _subclass_of(Format)
    ),
}
"""What a file may define, by the name that it has in the file."""


def check_definition(path: Path, attribute: str, values: object) -> None:
    """Refuse what a file defines under the name of a kind if it is not of that kind.

    Parameters
    ----------
    path : Path
        The file.
    attribute : str
        One of `PLUGIN_KINDS`.
    values : object
        What it defines under that name.

    Raises
    ------
    UsageError
        If it is not a mapping from free names to values of the kind.
    """
    kind = PLUGIN_KINDS[attribute]
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
    if not NAME.fullmatch(name):
        raise UsageError(
            f"{path}: expected a name of letters, digits, dots, hyphens and underscores for the "
            f"{registry.kind}, got {name!r}; rename it, for example to 'my-{registry.kind}'"
        )
    if not isinstance(value, type) and value.name != name:
        raise UsageError(
            f"{path}: expected the {registry.kind} under its own name {value.name!r}, got "
            f"{name!r}; rename one of the two"
        )


def _check_constructor(path: Path, name: str, value: object, kind: PluginKind) -> None:
    if not isinstance(value, type):
        return
    try:
        value(*kind.arguments)
    except Exception as error:
        raise UsageError(
            f"{path}: expected a class that can be built {kind.built}, got {name!r}: "
            f"{reason(error)}; give every other parameter a default, and define abstract methods"
        ) from error
