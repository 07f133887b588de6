"""From the results of a task to its table of scores by one metric."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.scores.basis import basis
from mocapbench.reports.scores.drawing import Drawing
from mocapbench.reports.scores.published import published_rows
from mocapbench.reports.scores.rows import Rows
from mocapbench.reports.scores.table import CaseHead, ScoreRow, ScoreTable
from mocapbench.reports.text import FEWEST_DECIMALS, slug

__all__ = ["score_table"]


def score_table(
    results: TaskResults, metric: str, styles: Mapping[str, DrawingStyle]
) -> ScoreTable:
    """Return the table of ``metric``: competitors best first, then references and papers' models.

    Parameters
    ----------
    results : TaskResults
    metric : str
    styles : mapping of str to DrawingStyle
        How each label is drawn.
    """
    counting = results.representative_cases(metric)
    others = [case for case in results.cases if case not in counting]
    shown = [*counting, *others] if len(results.cases) > 1 else []
    drawing = Drawing.of(results, metric, counting, styles)
    return ScoreTable(
        id=slug(results.layout.name, metric),
        metric=metric,
        title=results.metrics[metric].title,
        better=results.metrics[metric].better,
        basis=basis(results, metric, counting),
        mean_head=_mean_head(results, counting),
        heads=tuple(_head(results, case) for case in shown),
        rows=tuple(_rows(results, metric, counting, shown, drawing)),
        axis=drawing.axis,
    )


def _mean_head(results: TaskResults, counting: Sequence[CaseLayout]) -> CaseHead:
    """Return the head of the means, which is that of the case where there is but one."""
    if len(results.cases) == 1:
        return _head(results, results.cases[0])
    return CaseHead(f"mean of {format_count(len(counting), 'case')}")


def _head(results: TaskResults, case: CaseLayout) -> CaseHead:
    """Return the name of a case with what it varies and the name does not say."""
    facts = [
        f"{name} {value}" for name, value in case.columns.items() if str(value) not in case.name
    ]
    lacking = "recording missing" if case.name in results.without_data else ""
    generated = "generated" if case.synthetic and "synthetic" not in case.name else ""
    return CaseHead(case.name, tuple(filter(None, (*facts, generated, lacking))))


def _rows(
    results: TaskResults,
    metric: str,
    counting: Sequence[CaseLayout],
    shown: Sequence[CaseLayout],
    drawing: Drawing,
) -> Iterator[ScoreRow]:
    places = results.decimals.get(metric, FEWEST_DECIMALS)
    yield from Rows(results, metric, tuple(counting), tuple(shown), places, drawing)
    yield from published_rows(results, metric, counting, shown, places)
