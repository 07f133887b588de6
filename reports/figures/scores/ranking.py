"""The ranking of a task: a row a model, the best on top, the mean a dot, every case a tick."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import standings
from mocapbench.reports.figures.axes import BOTTOM, WIDTH, bottom_axis
from mocapbench.reports.figures.fitting import fit_scale, remark
from mocapbench.reports.figures.marks import dot, svg, vertical
from mocapbench.reports.figures.scale import LogScale, Scale
from mocapbench.reports.figures.scores.rows import NAMES, ROW, TOP, place_of, row
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import SvgFigure

__all__ = ["ranking"]


@dataclass(frozen=True)
class _Line:
    """A model: its mean over the cases that count, and its value in each."""

    label: str
    mean: float
    cases: Sequence[float]


def ranking(
    results: TaskResults, metric: str, styles: Mapping[str, DrawingStyle]
) -> SvgFigure | None:
    """Return one panel of all models, then references; None where there are fewer than two.

    Parameters
    ----------
    results : TaskResults
    metric : str
    styles : mapping of str to DrawingStyle
        How each label is drawn.
    """
    lines = _lines(results, metric)
    if len(lines) < 2:
        return None
    every = (value for line in lines for value in (line.mean, *line.cases))
    scale, bottom = fit_scale(every, NAMES, WIDTH - 8.0), TOP + ROW * len(lines)
    marks = [
        vertical(map(scale.place, scale.ticks(4)), TOP, bottom, "grid"),
        bottom_axis(scale, bottom, "logarithmic" if isinstance(scale, LogScale) else ""),
        *(_row(line, place, scale, styles[line.label]) for place, line in enumerate(lines)),
    ]
    info = results.metrics[metric]
    name = f"{info.title} of {format_count(len(lines), 'model')}"
    several = len(results.representative_cases(metric)) > 1
    ticks = "A dot is a mean over cases, a tick one case." if several else ""
    caption = " ".join(filter(None, (f"{info.better} is better.", ticks, remark(scale))))
    return SvgFigure(info.title, svg(WIDTH, bottom + BOTTOM, name, marks), (), caption)


def _lines(results: TaskResults, metric: str) -> list[_Line]:
    """Return a line for each label with a score: those that compete best first, then the others."""
    ranked = [standing.label for standing in standings(results, metric)]
    others = [label for label in results.layout.labels if label not in ranked]
    found = {label: results.case_means(metric, label) for label in (*ranked, *others)}
    return [_Line(label, float(np.mean(v)), v) for label, v in found.items() if v]


def _row(line: _Line, place: int, scale: Scale, style: DrawingStyle) -> str:
    y = place_of(place)
    ticks = vertical(map(scale.place, line.cases), y - 4.0, y + 4.0) if len(line.cases) > 1 else ""
    summary = f"{line.label}: {line.mean:.4g}, {format_count(len(line.cases), 'case')}"
    return row(style, place, ticks, dot(scale.place(line.mean), y, style.shape), title=summary)
