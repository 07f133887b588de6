"""A comparison for people: the terminal and Markdown."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import groupby

from rich.box import SIMPLE
from rich.table import Table

from mocapbench.benchmark.comparison.incomplete import incomplete_notes, losses
from mocapbench.benchmark.comparison.rows import POOLED, Row
from mocapbench.benchmark.registry import METRICS
from mocapbench.metrics.statistics import FEWEST_UNITS, Contrast, least_signed_rank_p
from mocapbench.reports import ChangeVerdict
from mocapbench.reports.markdown import escape, table_lines

__all__ = ["describe_metric", "format_value", "markdown", "notes", "outcome", "terminal"]

POWERLESS = (
    f"Where n is {FEWEST_UNITS}, Wilcoxon’s signed-rank test cannot go below p = "
    f"{least_signed_rank_p(FEWEST_UNITS):.4g}, however large the difference: go by the paired "
    "t-test."
)
MORE = (
    "Too few to test: where n counts folds, give `mocapbench run` more --folds; where it counts "
    "people, add recordings of more people, equally many of each."
)

TARGETED = (
    "For a metric that should be near a value, “better by” in all cases is of the mean distance "
    "over cases, not of the distance of the mean."
)


def outcome(row: Row, sides: tuple[str, str]) -> str:
    """Return who is better by the corrected t-test, or why that cannot be said."""
    verdict = row.verdict
    if verdict is ChangeVerdict.INCOMPLETE:
        return "; ".join(f"{side} {loss}" for side, loss in losses(row, sides))
    if verdict.more_than_chance:
        return f"{sides[verdict is ChangeVerdict.BETTER]} better"
    return str(verdict.value)


def describe_metric(name: str) -> str:
    """Return a metric's title, and what of it is better."""
    metric = METRICS.get(name)
    goal = metric.direction.value if metric.target is None else f"near {metric.target:g}"
    return f"{metric.title} ({goal} is better)"


def format_value(value: float) -> str:
    """Return a number with three digits, or a dash where there is none."""
    return "–" if math.isnan(value) else f"{value:.3g}"


def terminal(rows: Sequence[Row], sides: tuple[str, str]) -> Iterator[Table]:
    """Yield one table per task and metric; rows that are identical are left out.

    They are for a console that knows no markup.
    """
    for title, group in _by_metric(rows):
        shown = [row for row in group if row.verdict is not ChangeVerdict.IDENTICAL]
        table = Table(box=SIMPLE, padding=0, title=title, title_justify="left")
        for head in _columns(sides):
            table.add_column(head, overflow="fold")
        for row in shown:
            style = "bold" if row.verdict.more_than_chance else ""
            table.add_row(*_cells(row, sides), style=style)
        if shown:
            yield table


def markdown(rows: Sequence[Row], sides: tuple[str, str]) -> str:
    """Return every row, and the notes."""
    lines = [f"# {escape(' against '.join(sides))}", ""]
    for title, group in _by_metric(rows):
        cells = [_cells(row, sides) for row in group]
        lines += [f"## {escape(title)}", "", *table_lines(_columns(sides), cells), ""]
    return "\n".join([*lines, *(f"- {note}" for note in notes(rows, sides)), ""])


def notes(rows: Sequence[Row], sides: tuple[str, str]) -> list[str]:
    """Return what a reader of ``rows`` must know."""
    identical = sum(row.identical for row in rows)
    tested = {row.contrast.n for row in rows if row.contrast.tested}
    return [
        *incomplete_notes(rows, sides),
        "“Better by” comes with its own 95 % interval by Student’s t. Each p is corrected after "
        "Holm, single cases and all cases apart, and decides the outcome: an interval may exclude "
        "0 where p is above 0.05. P is by the Bayesian correlated t-test.",
        *([TARGETED] if any(map(_averages_distances, rows)) else []),
        "n counts people where cases or folds go through recordings of people, else independent "
        "folds or cases, as in the report. Fewer than five are too few to test, and so are more of "
        "which a few have most of the weight.",
        *([f"{identical} of {len(rows)} comparisons are identical."] if identical else []),
        *([POWERLESS] if FEWEST_UNITS in tested else []),
        *([MORE] if any(row.verdict is ChangeVerdict.UNTESTED for row in rows) else []),
    ]


def _averages_distances(row: Row) -> bool:
    return row.case == POOLED and METRICS.get(row.metric).target is not None


def _by_metric(rows: Sequence[Row]) -> Iterator[tuple[str, list[Row]]]:
    for (task, name), group in groupby(rows, key=lambda row: (row.task, row.metric)):
        yield f"{task}: {describe_metric(name)}", list(group)


def _columns(sides: tuple[str, str]) -> list[str]:
    tests = ["p (t)", "p (Wilcoxon)", "P better / equal / worse", "outcome"]
    return ["case", "n", *sides, f"{sides[0]} better by", *tests]


def _cells(row: Row, sides: tuple[str, str]) -> list[str]:
    contrast = row.contrast
    return [
        f"{row.entrant}: {row.case}" if row.entrant else row.case,
        *(str(contrast.n), format_value(contrast.first), format_value(contrast.second)),
        f"{format_value(contrast.advantage)} {_interval(contrast)}".strip(),
        *map(format_value, (row.t_p_holm, row.signed_rank_p_holm)),
        _probabilities(contrast),
        outcome(row, sides),
    ]


def _interval(contrast: Contrast) -> str:
    return (
        ""
        if math.isnan(contrast.low)
        else f"[{format_value(contrast.low)}, {format_value(contrast.high)}]"
    )


def _probabilities(contrast: Contrast) -> str:
    shares = (contrast.better, contrast.equivalent, contrast.worse)
    return "–" if math.isnan(contrast.better) else " / ".join(f"{share:.2f}" for share in shares)
