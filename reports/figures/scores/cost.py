"""Cost against error, with the models that nothing cheaper beats."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from markupsafe import Markup

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.figures.axes import LEFT, TOP, WIDTH, draw_axes, panels
from mocapbench.reports.figures.marks import dot, group, polyline, text
from mocapbench.reports.figures.scale import Scale, fit_scale, remark
from mocapbench.reports.figures.scores.best import mean_values
from mocapbench.reports.figures.styles import TRUTH, DrawingStyle
from mocapbench.reports.figures.svg_figure import SvgFigure, dot_keys

__all__ = ["cost_against_error", "front", "median_seconds"]

HEIGHT, FEWEST = 240.0, 3
LETTER = 12.0
"""Height of a name, in pixels."""
SHORTEST = 0.001
"""Seconds; what takes less is drawn there."""


def cost_against_error(
    results: TaskResults, styles: Mapping[str, DrawingStyle]
) -> SvgFigure | None:
    """Return a point for each model by its mean of the first metric and its median seconds.

    None with fewer than three models.
    """
    metric = results.layout.page.metrics[0]
    info, means, seconds = (
        results.metrics[metric],
        mean_values(results, metric),
        median_seconds(results),
    )
    labels = [label for label in means if label in seconds]
    if len(labels) < FEWEST:
        return None
    points = {label: (means[label], seconds[label]) for label in labels}
    ranked = [label for label in labels if label in results.layout.ranked]
    best = front([(info.loss(points[n][0]), points[n][1]) for n in ranked])
    drawn, note = _panel(points, [ranked[place] for place in best], info.title, styles)
    legend = dot_keys(styles[label] for label in labels)
    return SvgFigure("Cost against error", panels([drawn]), legend, note)


def front(points: Sequence[tuple[float, float]]) -> list[int]:
    """Return the places of the points that no other one beats in both numbers, by the first.

    Parameters
    ----------
    points : sequence of (float, float)
        Loss and cost; less is better.
    """
    best: list[int] = []
    for place in sorted(range(len(points)), key=points.__getitem__):
        if not best or points[place][1] < points[best[-1]][1]:
            best.append(place)
    return best


def median_seconds(results: TaskResults) -> dict[str, float]:
    """Return the median over the jobs that finished of the seconds to fit and predict."""
    done = results.records[results.records["status"] == "ok"]
    total = done[["fit_seconds", "predict_seconds"]].astype(float).sum(axis=1)
    medians = total.groupby(done["label"]).median()
    return {str(label): max(value, SHORTEST) for label, value in medians.items()}


def _panel(
    points: Mapping[str, tuple[float, float]],
    best: Sequence[str],
    title: str,
    styles: Mapping[str, DrawingStyle],
) -> tuple[Markup, str]:
    x = fit_scale((error for error, _ in points.values()), LEFT, WIDTH)
    y = fit_scale((seconds for _, seconds in points.values()), TOP + HEIGHT, TOP)
    line = np.array([points[label] for label in best])
    named = _apart(best, [y.place(points[label][1]) for label in best])
    marks = [
        group(TRUTH, polyline(x.places(line[:, 0]), y.places(line[:, 1]), "front")),
        *(
            group(
                styles[label],
                dot(x.place(error), y.place(seconds), styles[label].shape),
                _name(label, x, x.place(error), y.place(seconds)) if label in named else "",
                title=f"{label}: {error:.4g}, {seconds:.3g} s",
            )
            for label, (error, seconds) in points.items()
        ),
    ]
    label = f"Median seconds against {title}; on the front: {', '.join(best)}"
    return draw_axes((x, y), "", (title, "median seconds a fold"), marks, label), remark(x)


def _apart(labels: Sequence[str], heights: Sequence[float]) -> list[str]:
    """Return the labels whose names do not touch the one before; heights fall along the front."""
    chosen: list[str] = []
    last = -np.inf
    for label, height in zip(labels, heights, strict=True):
        if height - last >= LETTER:
            chosen.append(label)
            last = height
    return chosen


def _name(label: str, x: Scale, at: float, height: float) -> str:
    """Return the name beside a point, on the side that has room."""
    left = at > (x.start + x.stop) / 2.0
    return text(at - 8.0 if left else at + 8.0, height - 5.0, label, "end name" if left else "name")
