"""The regression check as a table: the values that differ from the reference values."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mocapbench.reports.tables.base import Cell, Table, headings
from mocapbench.reports.text import MINUS

__all__ = ["check_table"]

QUIET = ("same", "data missing")
LIMIT = 100
COLUMNS = ("reference", "run", "change", "allowance", "worst")
RULE = (
    "A metric is worse if its mean paired difference over folds, signed so that positive is worse, "
    "exceeds the allowance: the largest of an absolute floor, a share of the reference value, and "
    "k standard errors of the differences."
)


def check_table(check: Mapping[str, Any]) -> Table | None:
    """Return the values that failed or changed, failures first; None if there are none."""
    notable = [finding for finding in check["findings"] if finding["verdict"] not in QUIET]
    notable.sort(key=lambda finding: not finding["fails"])
    if not notable:
        return None
    hidden = len(notable) - LIMIT
    more = (f"{hidden} more: mocapbench check lists all.",) if hidden > 0 else ()
    return Table(
        id="regression-check",
        caption=f"Differences from the reference values in {check['reference']}",
        columns=(
            *headings(["verdict"]),
            *headings(["task", "case", "entrant", "metric"], "text"),
            *headings(["folds", "reference", "run", "worse by", "allowed", "worst fold by"]),
            *headings(["why"], "text"),
        ),
        rows=tuple(_row(finding) for finding in notable[:LIMIT]),
        notes=(RULE, *more),
    )


def _row(finding: Mapping[str, Any]) -> tuple[Cell, ...]:
    return (
        Cell(finding["verdict"], note="fails" if finding["fails"] else ""),
        *(Cell(finding[name], kind="text") for name in ("task", "case", "label", "metric")),
        Cell(str(finding.get("n", 0))),
        *(_number(finding.get(name)) for name in COLUMNS),
        Cell(finding["reason"], kind="text"),
    )


def _number(value: float | None) -> Cell:
    return Cell("" if value is None else f"{value:.5g}".replace("-", MINUS))
