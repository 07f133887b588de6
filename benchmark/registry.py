"""Models, tasks and metrics by name.

Ours and third parties' are found in the same way: by entry points of the groups
``mocapbench.models``, ``mocapbench.tasks`` and ``mocapbench.metrics``. A file of the user's own
adds models for one run (`load_model_file`).
"""

from __future__ import annotations

import hashlib
import sys
from importlib.machinery import SourceFileLoader
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from types import ModuleType
from typing import Any, Generic, TypeVar, cast

from mocapbench.baselines import Model
from mocapbench.benchmark.errors import UnknownNameError, UsageError
from mocapbench.benchmark.tasks.base import Task
from mocapbench.metrics import Metric

__all__ = ["METRICS", "MODELS", "TASKS", "Registry", "load_model_file"]

T = TypeVar("T")


class Registry(Generic[T]):
    """Names to objects; entry points are loaded when first asked for.

    Parameters
    ----------
    kind : str
        ``"model"``, ``"task"`` or ``"metric"``; the entry-point group is ``mocapbench.{kind}s``.
    """

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self._added: dict[str, T] = {}
        self._points: dict[str, EntryPoint] = {
            point.name: point for point in entry_points(group=f"mocapbench.{kind}s")
        }

    def names(self) -> tuple[str, ...]:
        """Return every registered name, sorted: the order of registration means nothing."""
        return tuple(sorted({*self._points, *self._added}))

    def add(self, name: str, value: T) -> None:
        """Register ``value`` under ``name``, in place of what had that name."""
        self._added[name] = value

    def is_installed(self, name: str) -> bool:
        """Return whether an installed package registers ``name``."""
        return name in self._points

    def get(self, name: str) -> T:
        """Return the object called ``name``.

        Raises
        ------
        UnknownNameError
            If there is none; the message suggests the nearest names.
        UsageError
            If its entry point cannot be imported.
        """
        if name not in self._added:
            self._added[name] = self._load(name)
        return self._added[name]

    def _load(self, name: str) -> T:
        if name not in self._points:
            raise UnknownNameError(self.kind, name, self.names())
        try:
            return cast(T, self._points[name].load())
        except (ImportError, AttributeError) as error:
            raise UsageError(
                f"{self.kind} {name!r} is registered as {self._points[name].value!r}, "
                f"which cannot be imported: {error}"
            ) from error


MODELS: Registry[type[Model]] = Registry("model")
TASKS: Registry[Task] = Registry("task")
METRICS: Registry[Metric[Any]] = Registry("metric")


def load_model_file(path: Path) -> tuple[str, ...]:
    """Register the models of a Python file that defines ``MODELS = {"name": ModelClass}``.

    Returns
    -------
    tuple of str
        The names registered.

    Raises
    ------
    UsageError
        If the file cannot be run or defines no such mapping.
    """
    module = _execute(path)
    models = getattr(module, "MODELS", None)
    if not (isinstance(models, dict) and models and all(map(_is_model, models.values()))):
        raise UsageError(
            f'{path}: expected MODELS = {{"name": ModelClass}} with subclasses of '
            f"mocapbench.baselines.Model, got {models!r}"
        )
    for name, model in models.items():
        _check_model(path, name, model)
        MODELS.add(name, model)
    return tuple(models)


def _check_model(path: Path, name: object, model: type[Model]) -> None:
    """Refuse a name that stands for something else already, and a class that cannot be built."""
    labels = {entrant.label for task in map(TASKS.get, TASKS.names()) for entrant in task.entrants}
    if not isinstance(name, str) or name in labels or MODELS.is_installed(name):
        raise UsageError(
            f"{path}: expected a name that no model or entrant has, got {name!r}; choose another"
        )
    try:
        model()
    except TypeError as error:
        raise UsageError(
            f"{path}: expected a model that can be built without arguments, got {name!r}: {error}"
        ) from error


def _execute(path: Path) -> ModuleType:
    """Run a Python file as a module whose name follows from its content."""
    if not path.is_file():
        raise UsageError(f"expected a Python file of models, got {str(path)!r}")
    name = f"mocapbench_user_{hashlib.sha256(path.read_bytes()).hexdigest()[:16]}"
    loader = SourceFileLoader(name, str(path))
    module = ModuleType(name)
    module.__file__ = str(path)
    sys.modules[name] = module  # where pickle and the source digest look for it
    try:
        loader.exec_module(module)
    except (Exception, SystemExit) as error:
        del sys.modules[name]
        raise UsageError(f"{path} cannot be run: {type(error).__name__}: {error}") from error
    return module


def _is_model(value: object) -> bool:
    return isinstance(value, type) and issubclass(value, Model)
