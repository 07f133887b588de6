"""The trend that models infer, beside the parent that drew the recordings: thesis Figure 6."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from mocapbench.benchmark.problems.base import Problem, Solution
from mocapbench.benchmark.tasks.base import Task
from mocapbench.datasets import Recording
from mocapbench.reports import Band, Curve, Illustration, Panel

__all__ = ["trend_sketch"]

TRUE, INFERRED = "true parent", "trend inferred"
WIDTH_95 = 1.96


def trend_sketch(
    problem: Problem, task: Task, solutions: Mapping[str, Solution]
) -> Sequence[Illustration]:
    """Return the trend of every entrant that has one, where the true parent is known."""
    told = {label: each for label, each in solutions.items() if "trend-mean" in each}
    if problem.parent is None or not told:
        return ()
    panels = tuple(
        _panel(problem.parent, problem.parent.channels.index(channel), label, solution)
        for channel in task.illustrated_channels
        for label, solution in told.items()
    )
    caption = (
        "the true parent, and its posterior mean and central 95 % band given the children. The "
        "band is that of the curve, without noise."
    )
    return (Illustration(task.name, "Underlying trend", caption, panels),)


def _panel(parent: Recording, column: int, label: str, solution: Solution) -> Panel:
    times, mean = solution["trend-times"], solution["trend-mean"][:, column]
    half = WIDTH_95 * np.sqrt(solution["trend-variance"][:, column])
    return Panel(
        f"{label}, {parent.channels[column]}",
        "time",
        "",
        (
            Curve(parent.times, parent.values[:, column], TRUE),
            Curve(times, mean, INFERRED),
        ),
        bands=(Band(times, mean - half, mean + half, INFERRED),),
    )
