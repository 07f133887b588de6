"""The table of the negative control: every entrant beside samples of an unrelated process."""

from __future__ import annotations

from collections.abc import Sequence

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.negative_control import (
    ENOUGH_CELLS,
    LEAST_VARIANCE_RATIO,
    NEAR_ZERO,
    Decision,
    Measure,
    NegativeControlResult,
    negative_control,
)
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.tables.base import ABSENT, Cell, Table, headings
from mocapbench.reports.text import number, plus_minus, slug

__all__ = ["negative_control_table"]

PLACES = 3
CAPTION = (
    "Negative control: each entrant’s score minus that of samples of an unrelated process, "
    "cell by cell"
)
TOO_FEW = "too few cells to tell"


def negative_control_table(results: TaskResults) -> Table | None:
    """Return the table of the negative control; None where the task has no control."""
    checked = negative_control(results)
    if not checked:
        return None
    control, *entrants = checked
    return Table(
        id=slug(results.layout.name, "control"),
        caption=CAPTION,
        columns=(
            *headings(["entrant"]),
            *headings(["verdict"], "text"),
            *headings(["cells", "MLC", "MCC", "variance ratio"]),
        ),
        rows=(*map(_row, entrants), _row(control, note="its MLC, no difference")),
        notes=_notes(checked),
    )


def _row(result: NegativeControlResult, note: str = "") -> tuple[Cell, ...]:
    cells = [_cell(measure) for measure in result.measures]
    return (
        Cell(result.label, note=note),
        Cell(result.verdict, kind="worse" if result.failed else "text"),
        Cell(str(result.n_cells)),
        *cells,
        *[ABSENT] * (3 - len(cells)),
    )


def _cell(measure: Measure) -> Cell:
    if measure.estimate is None:
        return ABSENT
    return Cell(
        number(measure.estimate.mean, PLACES),
        spread=plus_minus(measure.estimate.half_width, PLACES),
        note=_note(measure),
    )


def _note(measure: Measure) -> str:
    match measure.decision:
        case Decision.PASSED:
            return ""
        case Decision.UNDECIDED:
            return TOO_FEW
        case Decision.FAILED:
            return format_count(len(measure.offending), "offending cell")


def _notes(checked: Sequence[NegativeControlResult]) -> tuple[str, ...]:
    return (
        "Mean over case × fold ± half its 95 % interval (Student’s t). An entrant passes where "
        "the intervals of MLC and MCC lie above 0 and its mean variance ratio, which is not a "
        f"difference, is at least {LEAST_VARIANCE_RATIO}. The control passes where the interval of "
        f"its MLC contains 0 or lies within ± {NEAR_ZERO}. What does not pass has failed, or is "
        f"undecided: fewer than {ENOUGH_CELLS} cells leave both possible, or no single cell "
        "offends.",
        "Samples with too little variance score higher MLC and MCC, hence the lower limit of "
        "the variance ratio. Samples with too much variance score lower.",
        *(
            f"{result.label} need not pass: it {result.exempt}."
            for result in checked
            if result.exempt
        ),
    )
