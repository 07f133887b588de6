"""The figures of a task that stand on its own, beside those of single metrics."""

from __future__ import annotations

from collections.abc import Mapping

from mocapbench.reports.analysis.comparisons import every_comparison
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.figures.pictures.draw import draw
from mocapbench.reports.figures.scores.cost import cost_against_error
from mocapbench.reports.figures.scores.forest import forest
from mocapbench.reports.figures.scores.gap_error import gap_error
from mocapbench.reports.figures.scores.joint_errors import joint_errors
from mocapbench.reports.figures.scores.reliability import reliability
from mocapbench.reports.figures.styles import Style
from mocapbench.reports.figures.svg_figure import SvgFigure

__all__ = ["task_figures"]


def task_figures(
    results: TaskResults, bundle: Bundle, styles: Mapping[str, Style]
) -> list[SvgFigure]:
    """Return the figures of a task: of errors, calibration, cost and the papers, and its pictures.

    Parameters
    ----------
    results : TaskResults
    bundle : Bundle
    styles : mapping of str to Style
        Of all labels of the page, as `mocapbench.reports.figures.styles.model_styles` returns them.
    """
    drawn = [
        gap_error(results, bundle.parts, styles),
        joint_errors(results, bundle.parts, styles),
        reliability(results, styles),
        cost_against_error(results, styles),
        forest(results, every_comparison(results), styles),
    ]
    pictures = (each for each in bundle.illustrations if each.task == results.layout.name)
    return [*(each for each in drawn if each), *(draw(each, styles) for each in pictures)]
