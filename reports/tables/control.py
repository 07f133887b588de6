"""The table of the control check: every entrant beside what no resemblance scores."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from mocapbench.reports.analysis.controls import (
    LEAST_VARIANCE_RATIO,
    NEAR_ZERO,
    ControlFinding,
    Measure,
    control_check,
)
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.tables.base import ABSENT, Cell, Table, counted, headings, number, slug

__all__ = ["control_table"]

PLACES = 3
TOO_FEW = "too few cells to tell"
"""Of a measure that fails though every cell by itself speaks for the entrant."""


def control_table(results: TaskResults) -> Table | None:
    """Return the table of the control check; None where there is no control to check against."""
    findings = control_check(results)
    if not findings:
        return None
    control, *others = findings
    return Table(
        id=slug(results.layout.name, "control"),
        caption=f"Control: each entrant’s score less that of {control.label}, cell by cell",
        columns=(
            *headings(["entrant"]),
            *headings(["verdict"], "text"),
            *headings(["cells", "MLC", "MCC", "variance ratio"]),
        ),
        rows=(
            *(_row(finding) for finding in others),
            _row(control, note="its own MLC"),
        ),
        data=pd.DataFrame([_tidy(f, measure) for f in findings for measure in f.measures]),
        notes=_notes(findings),
    )


def _row(finding: ControlFinding, note: str = "") -> tuple[Cell, ...]:
    cells = [_cell(measure) for measure in finding.measures]
    return (
        Cell(finding.label, note=note),
        Cell(finding.verdict, kind="worse" if finding.failed else "text"),
        Cell(str(finding.n_cells)),
        *cells,
        *[ABSENT] * (3 - len(cells)),
    )


def _cell(measure: Measure) -> Cell:
    if measure.estimate is None:
        return ABSENT
    half = measure.estimate.half_width
    return Cell(
        number(measure.estimate.mean, PLACES),
        spread="" if half is None else number(half, PLACES),
        note="" if measure.passed else _count(measure),
    )


def _count(measure: Measure) -> str:
    return counted(len(measure.offending), "offending cell") if measure.offending else TOO_FEW


def _notes(findings: Sequence[ControlFinding]) -> tuple[str, ...]:
    return (
        "Mean over case × fold ± half its 95 % interval (Student’s t). An entrant passes where "
        "the intervals of MLC and MCC lie above 0 and its mean variance ratio, which is not a "
        f"difference, is at least {LEAST_VARIANCE_RATIO}; the control where the interval of its "
        f"own MLC contains 0 or lies within ± {NEAR_ZERO}.",
        "To draw too little variance raises MLC and MCC, hence the limit of the variance ratio; to "
        "draw too much lowers them.",
        *(
            f"{finding.label} need not pass: it {finding.excuse}."
            for finding in findings
            if finding.excuse
        ),
    )


def _tidy(finding: ControlFinding, measure: Measure) -> dict[str, object]:
    estimate = measure.estimate
    return {
        "label": finding.label,
        "measure": measure.name,
        "mean": None if estimate is None else estimate.mean,
        "half_width": None if estimate is None else estimate.half_width,
        "n": 0 if estimate is None else estimate.n,
        "passed": measure.passed,
        "offending": len(measure.offending),
        "excuse": finding.excuse,
    }
