"""The inferred trend beside the parent that drew the recordings.

After J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017, Figure 6.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.arrays import Arrays
from mocapbench.datasets import Recording
from mocapbench.reports import Axes, Curve, Illustration

__all__ = ["draw_trends"]

TRUE, INFERRED = "true parent", "inferred trend"
WIDTH_95 = 1.96


def draw_trends(solved: Solved[Any, Any], /, channels: tuple[str, ...]) -> Sequence[Illustration]:
    """Return the trend of every entrant that has one, where the true parent is known.

    One picture, a panel per channel and entrant; none if no entrant has a trend.

    Parameters
    ----------
    solved : Solved
    channels : tuple of str
    """
    parent = solved.problem.parent
    trends = {
        label: internals
        for label, internals in solved.internals.items()
        if "trend-mean" in internals
    }
    if parent is None or not trends:
        return ()
    panels = tuple(
        _panel(parent, parent.channels.index(channel), label, trend)
        for channel in channels
        for label, trend in trends.items()
    )
    caption = (
        "the true parent, and the posterior mean and central 95 % interval of the trend given "
        "the children. The interval is that of the curve, without noise."
    )
    return (Illustration(solved.task, "Underlying trend", caption, panels),)


def _panel(parent: Recording, column: int, label: str, trend: Arrays) -> Axes:
    times, mean = trend["trend-times"], trend["trend-mean"][:, column]
    half = WIDTH_95 * np.sqrt(trend["trend-variance"][:, column])
    return Axes(
        f"{label}, {parent.channels[column]}",
        "time",
        "",
        (
            Curve(parent.times, parent.values[:, column], TRUE),
            Curve(times, mean, INFERRED),
        ),
        bands={INFERRED: np.column_stack([times, mean - half, mean + half])},
    )
