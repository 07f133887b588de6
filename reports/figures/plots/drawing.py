"""From a tidy table to a figure as wide as asked, and to the bytes of a file."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from io import BytesIO
from typing import Any

import pandas as pd
from matplotlib import style
from matplotlib.figure import Figure

from mocapbench.reports.figures.plots.base import NothingToDrawError, Plot
from mocapbench.reports.figures.plots.kinds import FIGURE_KINDS
from mocapbench.reports.figures.plots.look import (
    EM,
    Styles,
    fit_legend,
    settings_of,
    shorten_labels,
    text_size,
)

__all__ = ["FIGURE_FORMATS", "draw_figure", "render_figure"]

FIGURE_FORMATS = ("pdf", "svg", "png")
"""The formats of files in which a figure for a paper can be written."""
_WITHOUT_DATES: dict[str, dict[str, Any]] = {
    "pdf": {"CreationDate": None},
    "svg": {"Date": None},
    "png": {},
}
"""What would differ between two files of one figure."""


def draw_figure(figure: Figure, plot: Plot, table: pd.DataFrame, styles: Styles) -> None:
    """Draw a table into a figure as wide as it is, a panel below the other or side by side.

    Parameters
    ----------
    figure : Figure
        Empty; it becomes as high as it must be.
    plot : Plot
    table : DataFrame
        As the plot tabulates it.
    styles : mapping of str to DrawingStyle
        Of all labels, so that a model has one colour in all figures and on the page.
    """
    table, styles = shorten_labels(table, styles)
    every, em = plot.add_styles(table, styles), EM * text_size()
    width = figure.get_figwidth() / em
    panels = [panel for _, panel in table.groupby("panel", sort=False)]
    n_columns = min(len(panels), max(1, int(width // plot.narrowest)))
    heights = _row_heights(plot, panels, width, n_columns)
    below = fit_legend(plot.keys(table), width)[1] + plot.foot(table)
    figure.set_figheight(em * (sum(heights) + below))
    grid = figure.add_gridspec(len(heights), n_columns, height_ratios=heights)
    for number, panel in enumerate(panels):
        plot.draw(figure.add_subplot(grid[divmod(number, n_columns)]), panel, every)
    plot.add_key(figure, table, every)


def render_figure(
    kind: str,
    table: pd.DataFrame,
    styles: Styles,
    size: tuple[float, float],
    formats: Sequence[str],
) -> dict[str, bytes]:
    """Return the files of a figure by format: the same bytes for the same table.

    Parameters
    ----------
    kind : str
        Of `FIGURE_KINDS`.
    table : DataFrame
        As `tabulate_figures` returns it.
    styles : mapping of str to DrawingStyle
        Of all labels of the run, so that a model has the colour of the report.
    size : tuple of float
        Of the text in points, and the width of the figure in inches.
    formats : sequence of str
        Of `FIGURE_FORMATS`.

    Raises
    ------
    NothingToDrawError
        If texts take all of the width.
    """
    points, width = size
    with style.context(["default", dict(settings_of(points))]):  # whatever the user's settings
        figure = Figure((width, width), layout="constrained")
        draw_figure(figure, FIGURE_KINDS[kind], table, styles)
        return {name: _save(figure, name) for name in formats}


def _row_heights(
    plot: Plot, panels: Sequence[pd.DataFrame], width: float, n_columns: int
) -> list[float]:
    """Return the height of each row of panels, in em."""
    heights = [plot.height(panel, width / n_columns) for panel in panels]
    starts = range(0, len(panels), n_columns)
    return [max(heights[start : start + n_columns]) for start in starts]


def _save(figure: Figure, name: str) -> bytes:
    file = BytesIO()
    with warnings.catch_warnings():
        warnings.filterwarnings("error", "constrained_layout not applied")
        try:
            figure.savefig(file, format=name, metadata=_WITHOUT_DATES[name])
        except UserWarning as error:
            width = f"{figure.get_figwidth() * 2.54:.1f} cm"
            raise NothingToDrawError(f"names and numbers leave no room in {width}") from error
    return file.getvalue()
