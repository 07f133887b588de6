"""A figure in a notebook: on new axes, which are shown there, or on axes that are given."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib import pyplot
from matplotlib.axes import Axes

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.figures.plots.base import Plot
from mocapbench.reports.figures.plots.drawing import draw_figure
from mocapbench.reports.figures.plots.look import Styles, legend_handles, shorten_labels
from mocapbench.reports.figures.styles import model_styles

__all__ = ["draw_on_axes"]


def draw_on_axes(
    plot: Plot, bundle: Bundle, metrics: Sequence[str], axes: Axes | None = None
) -> list[Axes]:
    """Return the axes on which the first figure of a kind is drawn.

    Parameters
    ----------
    plot : Plot
    bundle : Bundle
        Of one task.
    metrics : sequence of str
        None for those of its page.
    axes : Axes, optional
        For a figure of one panel; by default a new figure is made.

    Raises
    ------
    NothingToDrawError
        If the bundle lacks what the figure shows.
    """
    (layout,) = bundle.layouts
    table = next(iter(plot.tabulate(bundle, task_results(bundle, layout), metrics).values()))
    styles: Styles = model_styles(bundle.layouts)
    if axes is None:
        figure = pyplot.figure(layout="constrained")
        draw_figure(figure, plot, table, styles)
        return [*figure.axes]
    table, styles = shorten_labels(table, styles)
    plot.draw(axes, table, styles)
    if shown := plot.keys(table):
        axes.legend(handles=legend_handles({label: styles[label] for label in shown}))
    return [axes]
