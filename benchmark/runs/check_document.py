"""The file of a regression check in a run directory, which the report shows."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mocapbench.benchmark.foreign_files import (
    Index,
    Name,
    Text,
    list_schema,
    read_file,
    read_json,
    table_schema,
)

__all__ = ["read_check"]

_FINDING = table_schema(
    {
        "task": Name,
        "version": Index,
        "case": Name,
        "label": Name,
        "metric": Name,
        "verdict": Name,
        "fails": bool,
        "reason": Text,
    },
    optional={
        "n": Index,
        **dict.fromkeys(("reference", "run", "change", "allowance", "worst"), float | None),
    },
)
_CHECK = table_schema(
    {"reference": Name, "summary": Text, "passed": bool, "findings": list_schema(_FINDING)}
)


def read_check(path: Path) -> Mapping[str, Any]:
    """Return what a regression check found.

    Raises
    ------
    ForeignFileError
        If the file is damaged.
    """
    return read_file(path, "a check", "run `mocapbench check` again", _read_whole)


def _read_whole(path: Path) -> Mapping[str, Any]:
    check: Mapping[str, Any] = read_json(path, _CHECK)
    return check
