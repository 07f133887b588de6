"""Tolerances of the regression gate from a TOML file.

::

    [same]                     # unless a metric has its own; what is left out keeps its default
    relative = 1e-9

    [cross]
    k = 3
    relative = 0.02

    [cross.metrics.msll]       # over the table above
    absolute = 0.01
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

from mocapbench.benchmark.errors import UnknownNameError, UsageError
from mocapbench.benchmark.gate.environment import Environment
from mocapbench.benchmark.gate.rule import DEFAULT_TOLERANCES, Tolerance
from mocapbench.benchmark.registry import METRICS

__all__ = ["read_tolerances"]

_METRICS = "metrics"
_NAMES = tuple(parameter.name for parameter in fields(Tolerance))


def read_tolerances(environment: Environment, path: Path | None) -> Mapping[str, Tolerance]:
    """Return the tolerance of every metric for ``environment``, as the file changes them.

    Raises
    ------
    UsageError
        If the file cannot be read, or holds something else.
    """
    tables = _read(path) if path else {}
    _check_names("", tables, tuple(Environment))
    read = {level: _tolerances(level, tables.get(level, {})) for level in Environment}
    return read[environment]


def _read(path: Path) -> Mapping[str, Any]:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise UsageError(f"--tolerances: {path} cannot be read as TOML: {error}") from error


def _tolerances(environment: Environment, table: object) -> dict[str, Tolerance]:
    options = _table(environment, table)
    own = _table(f"{environment}.{_METRICS}", options.get(_METRICS, {}))
    _check_names(environment, options, (*_NAMES, _METRICS))
    general = {name: value for name, value in options.items() if name != _METRICS}
    default = _change_tolerance(DEFAULT_TOLERANCES[environment], environment, general)
    for name in own:
        METRICS.get(name)
    return {
        name: _change_tolerance(default, f"{environment}.{_METRICS}.{name}", own.get(name, {}))
        for name in METRICS.names()
    }


def _change_tolerance(tolerance: Tolerance, where: str, table: object) -> Tolerance:
    options = _table(where, table)
    _check_names(where, options, _NAMES)
    for name, value in options.items():
        number = isinstance(value, int | float) and not isinstance(value, bool)
        if not (number and math.isfinite(value) and value >= 0):
            raise UsageError(
                f"--tolerances: {where}.{name}: expected a number from 0, got {value!r}"
            )
    return replace(tolerance, **options)


def _table(where: str, value: object) -> Mapping[str, Any]:
    if not isinstance(value, dict):
        raise UsageError(f"--tolerances: {where}: expected a table, got {value!r}")
    return value


def _check_names(where: str, options: Mapping[str, Any], known: tuple[str, ...]) -> None:
    for name in options:
        if name not in known:
            raise UnknownNameError(f"entry of --tolerances {where}".rstrip(), name, known)
