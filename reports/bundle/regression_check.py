"""The result of a regression check, as the report shows it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

__all__ = ["RegressionCheck"]


@dataclass(frozen=True, eq=False)
class RegressionCheck:
    """The comparison of a run with stored reference values.

    Parameters
    ----------
    reference : str
        Where the reference values come from.
    summary : str
        Counts and environment in one line.
    passed : bool
    findings : sequence of mapping
        One per (task, case, label, metric): these names, ``verdict``, ``fails``, ``reason``, and
        where values were paired ``n``, ``reference``, ``run``, ``change``, ``worst`` and
        ``allowance``.
    """

    reference: str
    summary: str
    passed: bool
    findings: Sequence[Mapping[str, Any]]
