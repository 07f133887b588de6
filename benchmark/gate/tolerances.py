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

from collections.abc import Mapping
from dataclasses import fields, replace
from pathlib import Path
from typing import Annotated, Any

from msgspec import Meta

from mocapbench.benchmark.errors import UnknownNameError
from mocapbench.benchmark.foreign_files import fit_schema, read_file, read_toml, table_schema
from mocapbench.benchmark.gate.environment import Environment
from mocapbench.benchmark.gate.rule import DEFAULT_TOLERANCES, Tolerance
from mocapbench.benchmark.registry import METRICS

__all__ = ["read_tolerances"]

_METRICS = "metrics"
_NAMES = tuple(parameter.name for parameter in fields(Tolerance))
_OPTIONS = dict.fromkeys(_NAMES, Annotated[float, Meta(ge=0.0, le=1e300)])


def read_tolerances(environment: Environment, path: Path | None) -> Mapping[str, Tolerance]:
    """Return the tolerance of every metric for ``environment``, as the file changes them.

    Raises
    ------
    UsageError
        If the file cannot be read, or holds something else.
    """
    tables = read_file(path, "tolerances", "mend it", _read_tables) if path else {}
    return _tolerances(environment, tables.get(environment, {}))


def _read_tables(path: Path) -> Mapping[str, Any]:
    """Return the tables of a file, which have no entry but known ones."""
    document: dict[str, Any] = read_toml(path, dict[str, Any])
    own = table_schema({}, dict.fromkeys(METRICS.names(), table_schema({}, _OPTIONS)))
    level = table_schema({}, {**_OPTIONS, _METRICS: own})
    tables: Mapping[str, Any] = fit_schema(
        document, table_schema({}, dict.fromkeys(Environment, level))
    )
    _check_names("", document, tuple(Environment))
    for environment, table in document.items():
        _check_names(environment, table, (*_NAMES, _METRICS))
        for name, options in table.get(_METRICS, {}).items():
            METRICS.get(name)
            _check_names(f"{environment}.{_METRICS}.{name}", options, _NAMES)
    return tables


def _tolerances(environment: Environment, table: Mapping[str, Any]) -> dict[str, Tolerance]:
    own = table.get(_METRICS, {})
    general = {name: value for name, value in table.items() if name != _METRICS}
    default = replace(DEFAULT_TOLERANCES[environment], **general)
    return {name: replace(default, **own.get(name, {})) for name in METRICS.names()}


def _check_names(where: str, options: Mapping[str, Any], known: tuple[str, ...]) -> None:
    for name in options:
        if name not in known:
            raise UnknownNameError(f"entry of --tolerances {where}".rstrip(), name, known)
