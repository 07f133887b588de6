"""Figures of scores, as ``mocapbench figures`` draws them, on axes of matplotlib.

They take the table that `mocapbench.evaluate` returns. Seaborn draws them: ``pip install
'mocapbench[figures]'``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mocapbench import reports
from mocapbench.benchmark.errors import UnknownNameError
from mocapbench.benchmark.in_memory.extras import require_extra
from mocapbench.benchmark.results.evaluated_gaps import (
    bundle_frames,
    bundle_scores,
    require_columns,
)
from mocapbench.reports import Bundle

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["along", "along_gap", "by_recording", "calibration", "cost", "error_bars", "ranks"]


def error_bars(
    scores: pd.DataFrame, metric: str = "", *, by: str = "gap", ax: Axes | None = None
) -> Axes:
    """Draw the mean of each model with its 95 % interval, and every gap or recording as a dot.

    Parameters
    ----------
    scores : DataFrame
        What `mocapbench.evaluate` returns.
    metric : str, optional
        By default MSE, or the first of the scores.
    by : str, default="gap"
        What counts as one, as `mocapbench.compare` takes it: ``"gap"`` or ``"recording"``.
    ax : matplotlib.axes.Axes, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    ValueError
        If it is no table of scores, or has none by the metric.
    ImportError
        If seaborn is not installed.

    Examples
    --------
    >>> import mocapbench, mocapbench.figures
    >>> from mocapbench.datasets import GaitLibrary
    >>> walk = GaitLibrary().recording("01_01")
    >>> scores = mocapbench.evaluate(walk, ["linear", "pchip"], metrics=["mse"])
    >>> axes = mocapbench.figures.error_bars(scores)
    >>> [tick.get_text() for tick in axes.get_yticklabels()]
    ['pchip', 'linear']
    """
    return _draw("error-bars", bundle_scores(scores, by), metric, ax)[0]


def by_recording(scores: pd.DataFrame, metric: str = "", *, by: str = "gap") -> NDArray[Any]:
    """Draw the means of each recording by MSE, SMSE and MSLL, or by one metric.

    Parameters
    ----------
    scores : DataFrame
        What `mocapbench.evaluate` returns.
    metric : str, optional
        By default MSE, or the first of the scores.
    by : str, default="gap"
        What counts as one: ``"gap"`` or ``"recording"``.

    Returns
    -------
    ndarray of matplotlib.axes.Axes
        One for each metric.
    """
    return np.array(_draw("by-case", bundle_scores(scores, by, "recording"), metric, None))


def along(
    scores: pd.DataFrame, column: str, metric: str = "", *, by: str = "gap", ax: Axes | None = None
) -> Axes:
    """Draw the means of each model against a column of numbers, with 95 % intervals.

    Parameters
    ----------
    scores : DataFrame
        What `mocapbench.evaluate` returned several times, such as with gaps of several lengths or
        several numbers of training recordings.
    column : str
        A column that you added, such as that length.
    metric : str, optional
        By default MSE, or the first of the scores.
    by : str, default="gap"
        What counts as one: ``"gap"`` or ``"recording"``.
    ax : matplotlib.axes.Axes, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.axes.Axes

    Examples
    --------
    >>> import pandas, mocapbench, mocapbench.figures
    >>> from mocapbench.datasets import GaitLibrary
    >>> walk = GaitLibrary().recording("01_01")
    >>> lengths = {seconds: mocapbench.Gaps(seconds) for seconds in (0.1, 0.4)}
    >>> of_lengths = (
    ...     mocapbench.evaluate(walk, ["linear"], hide, metrics=["mse"]).assign(seconds=seconds)
    ...     for seconds, hide in lengths.items()
    ... )
    >>> axes = mocapbench.figures.along(pandas.concat(of_lengths), "seconds")
    >>> axes.get_xlabel()
    'seconds'
    """
    require_columns(scores, [column])
    if not pd.api.types.is_numeric_dtype(scores[column].dtype):
        raise ValueError(f"expected numbers in the column {column}, got {scores[column].dtype}")
    require_extra("seaborn", "figures", "figures")
    plot = reports.AlongColumn(column, column)
    return _draw_plot(plot, bundle_scores(scores, by, column), metric, ax)[0]


def along_gap(errors: pd.DataFrame, *, ax: Axes | None = None) -> Axes:
    """Draw the mean error of each model along the gaps, from their first frame to their last.

    Parameters
    ----------
    errors : DataFrame
        What `mocapbench.evaluate_frames` returns, of gaps of eight frames or more.
    ax : matplotlib.axes.Axes, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.axes.Axes

    Examples
    --------
    >>> import mocapbench, mocapbench.figures
    >>> from mocapbench.datasets import GaitLibrary
    >>> walk = GaitLibrary().recording("01_01")
    >>> errors = mocapbench.evaluate_frames(walk, ["linear"])
    >>> mocapbench.figures.along_gap(errors).get_xlabel()
    'position in the gap'
    """
    return _draw("along-gap", bundle_frames(errors), "", ax)[0]


def calibration(scores: pd.DataFrame, *, ax: Axes | None = None) -> Axes:
    """Draw how often truths fall into predicted intervals, against how often they should.

    Parameters
    ----------
    scores : DataFrame
        What `mocapbench.evaluate` returns, with two metrics of coverage or more.
    ax : matplotlib.axes.Axes, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.axes.Axes
    """
    return _draw("calibration", bundle_scores(scores), "", ax)[0]


def ranks(
    scores: pd.DataFrame, metric: str = "", *, by: str = "gap", ax: Axes | None = None
) -> Axes:
    """Draw mean ranks of models, with bars that join those that are not separable.

    Parameters
    ----------
    scores : DataFrame
        What `mocapbench.evaluate` returns, of three models or more.
    metric : str, optional
        By default MSE, or the first of the scores.
    by : str, default="gap"
        What counts as one: ``"gap"`` or ``"recording"``.
    ax : matplotlib.axes.Axes, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.axes.Axes
    """
    return _draw("ranks", bundle_scores(scores, by), metric, ax)[0]


def cost(scores: pd.DataFrame, metric: str = "", *, ax: Axes | None = None) -> Axes:
    """Draw how long models took against their mean.

    Parameters
    ----------
    scores : DataFrame
        What `mocapbench.evaluate` returns, with a column ``fit_seconds`` of yours.
    metric : str, optional
        By default MSE, or the first of the scores.
    ax : matplotlib.axes.Axes, optional
        Where to draw; by default in a new figure.

    Returns
    -------
    matplotlib.axes.Axes
    """
    require_columns(scores, ["fit_seconds"])
    return _draw("cost", bundle_scores(scores), metric, ax)[0]


def _draw(kind: str, bundle: Bundle, metric: str, ax: Axes | None) -> list[Axes]:
    """Return the axes of a kind of figure."""
    require_extra("seaborn", "figures", "figures")
    return _draw_plot(reports.FIGURE_KINDS[kind], bundle, metric, ax)


def _draw_plot(plot: reports.Plot, bundle: Bundle, metric: str, ax: Axes | None) -> list[Axes]:
    if metric and metric not in bundle.metrics:
        raise UnknownNameError("metric of these scores", metric, [*bundle.metrics])
    return reports.draw_on_axes(plot, bundle, [metric] if metric else [], ax)
