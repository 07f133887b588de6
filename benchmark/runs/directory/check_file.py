"""What the last regression check of a run found, beside its plan."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mocapbench.basics.whole_files import write_text

__all__ = ["CHECK", "read_check", "write_check"]

CHECK = "check.json"
_PARTS = {"reference", "summary", "passed", "findings"}


def write_check(path: Path, check: Mapping[str, Any]) -> None:
    """Write what a check found, whole or not at all."""
    write_text(path, json.dumps(check, indent=1))


def read_check(path: Path) -> Mapping[str, Any]:
    """Return what a check found.

    Raises
    ------
    ValueError
        If the file does not hold it.
    """
    try:
        check = dict(json.loads(path.read_text(encoding="utf-8")))
        if check.keys() != _PARTS:
            raise ValueError(f"it holds {sorted(check)}")
        return check
    except TypeError as error:
        raise ValueError(str(error)) from error
