"""The figures of a task: those that are open, and those that are folded."""

from __future__ import annotations

from collections.abc import Mapping

from mocapbench.reports.analysis.comparisons import every_comparison
from mocapbench.reports.analysis.ranks import ranks_over_units
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.error_parts import ErrorParts
from mocapbench.reports.figures.scores.along import curves_along
from mocapbench.reports.figures.scores.cost import cost_against_error
from mocapbench.reports.figures.scores.dots import dot_plot
from mocapbench.reports.figures.scores.forest import forest
from mocapbench.reports.figures.scores.gap_error import gap_error
from mocapbench.reports.figures.scores.joint_errors import joint_errors
from mocapbench.reports.figures.scores.ranks import rank_figure
from mocapbench.reports.figures.scores.reliability import reliability
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import SvgFigure

__all__ = ["folded_figures", "open_figures"]

Styles = Mapping[str, DrawingStyle]


def open_figures(results: TaskResults, parts: ErrorParts, styles: Styles) -> list[SvgFigure]:
    """Return the course of the first metric along a column or a gap, and ranks if these separate.

    Parameters
    ----------
    results : TaskResults
    parts : ErrorParts
    styles : mapping of str to DrawingStyle
        Of all labels of the page, as `mocapbench.reports.figures.styles.model_styles` returns them.
    """
    page = results.layout.page
    metric = page.metrics[0]
    curves = [curves_along(results, metric, column, styles) for column in page.along]
    ranks = _ranks(results, metric, styles)
    return _drop_missing(*curves, gap_error(results, parts, styles), ranks)


def folded_figures(results: TaskResults, parts: ErrorParts, styles: Styles) -> list[SvgFigure]:
    """Return the figures of joints, cases, calibration, cost and published values.

    The parameters are those of `open_figures`.
    """
    page = results.layout.page
    by_case = None if page.along or page.crossed else dot_plot(results, page.metrics[0], styles)
    return _drop_missing(
        joint_errors(results, parts, styles),
        by_case,
        reliability(results, styles),
        cost_against_error(results, styles),
        forest(results, every_comparison(results), styles),
    )


def _ranks(results: TaskResults, metric: str, styles: Styles) -> SvgFigure | None:
    losses, title = ranks_over_units(results, metric), results.metrics[metric].title
    if losses is None:
        return None
    return rank_figure(losses, f"{title}, ranks over {losses.index.name}s", styles)


def _drop_missing(*figures: SvgFigure | None) -> list[SvgFigure]:
    return [figure for figure in figures if figure is not None]
