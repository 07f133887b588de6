"""Dot plots: a panel a case, a row a model, the best on top, every fold a tick."""

from __future__ import annotations

from collections.abc import Mapping

from markupsafe import Markup

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.units import FoldSample
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.figures.axes import BOTTOM, WIDTH, bottom_axis, panels
from mocapbench.reports.figures.intervals import centre, interval
from mocapbench.reports.figures.marks import dot, horizontal, svg, text, vertical
from mocapbench.reports.figures.scale import LogScale, Scale, fit_scale, remark
from mocapbench.reports.figures.scores.fold_values import FoldValues, fold_values
from mocapbench.reports.figures.scores.rows import NAMES, ROW, TOP, place_of, row
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import SvgFigure

__all__ = ["dot_plot"]

MOST_PANELS = 6
"""More cases are for the strips of the table, which show them on one scale."""
WINDOWS = "windows of one recording are one unit, so there is no interval."


def dot_plot(
    results: TaskResults, metric: str, styles: Mapping[str, DrawingStyle]
) -> SvgFigure | None:
    """Return a panel for each case; None unless there are two to six, which differ in scale."""
    values = fold_values(results, metric)
    scored = {case for case, _ in values}
    cases = [case for case in results.cases if case.name in scored]
    if not 1 < len(cases) <= MOST_PANELS:
        return None
    drawn = [_panel(results, metric, case, values, styles) for case in cases]
    alone = all(sample.n_units == 1 for sample in values.values())
    overlap = (WINDOWS,) if alone and not results.layout.independent_folds else ()
    remarks = dict.fromkeys(remark for _, remark in drawn if remark)
    return SvgFigure(
        f"{results.metrics[metric].short} by case",
        panels(panel for panel, _ in drawn),
        (),
        " ".join([*overlap, *remarks]),
    )


def _panel(
    results: TaskResults,
    metric: str,
    case: CaseLayout,
    values: FoldValues,
    styles: Mapping[str, DrawingStyle],
) -> tuple[Markup, str]:
    """Return the panel of one case, and a remark on its axis."""
    of_case = {label: sample for (name, label), sample in values.items() if name == case.name}
    every = (value for sample in of_case.values() for value in sample.values)
    scale = fit_scale(every, NAMES, WIDTH - 8.0)
    loss = results.metrics[metric].loss
    order = sorted(of_case, key=lambda label: loss(centre(of_case[label], scale)))
    bottom = TOP + ROW * len(order)
    rows = (_row(styles[label], of_case[label], place, scale) for place, label in enumerate(order))
    marks = [
        text(0.0, 13.0, case.heading, "title"),
        vertical(map(scale.place, scale.ticks(4)), TOP, bottom, "grid"),
        bottom_axis(scale, bottom, "logarithmic" if isinstance(scale, LogScale) else ""),
        *rows,
    ]
    name = f"{results.metrics[metric].title} of {format_count(len(order), 'model')}, {case.heading}"
    return svg(WIDTH, bottom + BOTTOM, name, marks), remark(scale)


def _row(style: DrawingStyle, sample: FoldSample, place: int, scale: Scale) -> str:
    """Return ticks, interval and dot of a model."""
    y, values = place_of(place), sample.values
    ends = interval(sample, scale)
    low, high = (min(max(end, scale.low), scale.high) for end in ends or (scale.low, scale.low))
    middle = centre(sample, scale)
    marks = (
        horizontal(scale.place(low), scale.place(high), y) if ends else "",
        vertical(map(scale.place, values), y - 4.0, y + 4.0) if len(values) > 1 else "",
        dot(scale.place(middle), y, style.shape),
    )
    summary = f"{style.label}: {middle:.4g}, {format_count(len(values), 'fold')}"
    return row(style, place, *marks, title=summary)
