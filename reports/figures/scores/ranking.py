"""The ranking of a task: a row a model, the best on top, the mean a dot, every case a tick."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import chain

import numpy as np

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import standings
from mocapbench.reports.figures.axes import BOTTOM, WIDTH, bottom_axis
from mocapbench.reports.figures.marks import dot, svg, vertical
from mocapbench.reports.figures.scale import LogScale, Scale, fit_scale, remark
from mocapbench.reports.figures.scores.rows import NAMES, ROW, TOP, place_of, row
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import SvgFigure

__all__ = ["ranking"]


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
    found = _case_means(results, metric)
    if len(found) < 2:
        return None
    every = chain.from_iterable(found.values())  # a mean lies within its values
    scale, bottom = fit_scale(every, NAMES, WIDTH - 8.0), TOP + ROW * len(found)
    marks = [
        vertical(map(scale.place, scale.ticks(4)), TOP, bottom, "grid"),
        bottom_axis(scale, bottom, "logarithmic" if isinstance(scale, LogScale) else ""),
        *(_row(styles[n], place, found[n], scale) for place, n in enumerate(found)),
    ]
    info = results.metrics[metric]
    name = f"{info.title} of {format_count(len(found), 'model')}"
    several = len(results.representative_cases(metric)) > 1
    ticks = "A dot is a mean over cases, a tick one case." if several else ""
    caption = " ".join(filter(None, (f"{info.better} is better.", ticks, remark(scale))))
    return SvgFigure(info.title, svg(WIDTH, bottom + BOTTOM, name, marks), (), caption)


def _case_means(results: TaskResults, metric: str) -> dict[str, list[float]]:
    """Return the means of each label with a score: those that compete best first, then others."""
    ranked = [standing.label for standing in standings(results, metric)]
    others = [label for label in results.layout.labels if label not in ranked]
    found = {label: results.case_means(metric, label) for label in (*ranked, *others)}
    return {label: means for label, means in found.items() if means}


def _row(style: DrawingStyle, place: int, means: Sequence[float], scale: Scale) -> str:
    y, mean = place_of(place), float(np.mean(means))
    ticks = vertical(map(scale.place, means), y - 4.0, y + 4.0) if len(means) > 1 else ""
    summary = f"{style.label}: {mean:.4g}, {format_count(len(means), 'case')}"
    return row(style, place, ticks, dot(scale.place(mean), y, style.shape), title=summary)
