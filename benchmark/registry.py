"""Models, tasks, metrics, libraries of recordings and formats by name: five kinds of plug-in.

Ours and third parties' are found in the same way: by entry points of the groups
``mocapbench.models``, ``mocapbench.tasks``, ``mocapbench.metrics``, ``mocapbench.libraries`` and
``mocapbench.formats``. A file of the user's own adds to any of them for one run
(`mocapbench.benchmark.plugins`). Entry points of ``mocapbench.calibrations`` say which models take
part in a wrapper that calibrates them.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import cached_property
from importlib.metadata import EntryPoint
from typing import TYPE_CHECKING, Any, Generic, TypeVar, cast

from mocapbench.benchmark.entry_points import find_entry_points
from mocapbench.benchmark.errors import UnregisteredNameError, UsageError
from mocapbench.benchmark.messages import reason

if TYPE_CHECKING:  # most commands need names alone, and models take long to import
    from mocapbench.baselines import Model
    from mocapbench.benchmark.tasks.base import Task
    from mocapbench.datasets import Format, Library
    from mocapbench.metrics import Metric

__all__ = [
    "CALIBRATIONS",
    "FORMATS",
    "LIBRARIES",
    "METRICS",
    "MODELS",
    "NAME",
    "REGISTRIES",
    "TASKS",
    "UNCALIBRATED",
    "Calibration",
    "Registry",
    "build_unfitted",
    "find_calibration",
]

T = TypeVar("T")

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]*")
"""A name of a user's own that every option of the command line can take."""


class Registry(Generic[T]):
    """Names to objects; entry points are loaded when first asked for.

    Parameters
    ----------
    kind : str
        What they are, in the singular.
    group : str
        The group of entry points.
    """

    def __init__(self, kind: str, group: str) -> None:
        self.kind = kind
        self.group = group
        self._added: dict[str, T] = {}

    @cached_property
    def _points(self) -> dict[str, EntryPoint]:
        return find_entry_points(self.group)

    def names(self) -> tuple[str, ...]:
        """Return every registered name, sorted: the order of registration means nothing."""
        return tuple(sorted({*self._points, *self._added}))

    def add(self, name: str, value: T) -> None:
        """Register ``value`` under ``name``, in place of what had that name."""
        self._added[name] = value

    @contextmanager
    def lend(self, name: str, value: T) -> Iterator[None]:
        """Register ``value`` within the context alone, under a name that nothing else has."""
        self.add(name, value)
        try:
            yield
        finally:
            del self._added[name]

    def names_of_others(self) -> tuple[str, ...]:
        """Return the names that other packages or files of the user's register, sorted."""
        return tuple(name for name in self.names() if not self.is_ours(name))

    def is_ours(self, name: str) -> bool:
        """Return whether mocapbench itself registers ``name``."""
        point = self._points.get(name)
        return point is not None and point.value.startswith("mocapbench.")

    def is_loaded(self, name: str) -> bool:
        """Return whether the object is there: it was asked for, or added."""
        return name in self._added

    def is_installed(self, name: str) -> bool:
        """Return whether an installed package registers ``name``."""
        return name in self._points

    def get(self, name: str) -> T:
        """Return the object called ``name``.

        Raises
        ------
        UnregisteredNameError
            If there is none; the message suggests the nearest names.
        UsageError
            If its entry point cannot be imported.
        """
        if name not in self._added:
            self._added[name] = self._load(name)
        return self._added[name]

    def _load(self, name: str) -> T:
        if name not in self._points:
            raise UnregisteredNameError(self.kind, name, self.names())
        try:
            return cast(T, self._points[name].load())
        except (ImportError, AttributeError) as error:
            raise UsageError(
                f"{self.kind} {name!r} is registered as {self._points[name].value!r}, "
                f"which cannot be imported: {reason(error)}"
            ) from error


Calibration = Callable[[Any], "Model"]
"""From a model to one with calibrated variances, such as `mocapbench.baselines.Calibrated`."""

CALIBRATIONS: Registry[Calibration] = Registry("calibration", "mocapbench.calibrations")
"""What calibrates a model when it takes part, by the name of the model."""

UNCALIBRATED = "-uncalibrated"
"""The end of the name under which a model takes part without its calibration."""


class _Models(Registry["type[Model]"]):
    """Models by name; one with a calibration has a second name, which is not listed."""

    def get(self, name: str) -> type[Model]:
        """Return the class of the model called ``name``; see `Registry.get`."""
        return super().get(_without_end(name))


def _without_end(name: str) -> str:
    """Return the listed name of the model that ``name`` stands for."""
    listed = name.removesuffix(UNCALIBRATED)
    return listed if listed in CALIBRATIONS.names() else name


def find_calibration(name: str) -> Calibration | None:
    """Return what calibrates the model called ``name``; None if it takes part as it is."""
    return CALIBRATIONS.get(name) if name in CALIBRATIONS.names() else None


MODELS: Registry[type[Model]] = _Models("model", "mocapbench.models")
"""The classes of models that are registered, by name."""
TASKS: Registry[Task] = Registry("task", "mocapbench.tasks")
"""The tasks that are registered, by name."""
METRICS: Registry[Metric[Any]] = Registry("metric", "mocapbench.metrics")
"""The metrics that are registered, by name."""
LIBRARIES: Registry[type[Library]] = Registry("library", "mocapbench.libraries")
"""The classes of libraries of recordings that are registered, by name."""
FORMATS: Registry[type[Format]] = Registry("format", "mocapbench.formats")
"""The classes of formats of files that are registered, by name."""

REGISTRIES = (MODELS, TASKS, METRICS, LIBRARIES, FORMATS)


def build_unfitted(name: str, parameters: Mapping[str, object] | None = None) -> Model:
    """Return the model called ``name``, not fitted, which says what it provides and needs.

    Parameters
    ----------
    name : str
    parameters : mapping, optional
        In place of defaults, as far as the model has them.

    Raises
    ------
    UnregisteredNameError
        If there is none.
    UsageError
        If it cannot be built without arguments.
    """
    kind = MODELS.get(name)
    try:
        model = kind()
    except Exception as error:
        raise UsageError(
            f"model {name!r}: expected a class that can be built without arguments, got: "
            f"{reason(error)}; give every parameter a default, and define abstract methods"
        ) from error
    known = model.get_params()
    own = {key: value for key, value in (parameters or {}).items() if key in known}
    model.set_params(**own)
    return model
