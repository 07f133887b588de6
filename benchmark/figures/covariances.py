"""True and estimated covariances side by side: thesis Figures 11–13."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.problems.base import Solution
from mocapbench.benchmark.problems.recover import LAYERS, RecoverProblem
from mocapbench.benchmark.tasks.base import Task
from mocapbench.reports import HeatMap, HeatMaps

__all__ = ["recovery_sketch"]

EVERY = 2
"""Every so many points are drawn."""
TITLES = {
    "parent": "Covariance of the parent, K_g",
    "child": "Covariance of the children, K_f",
}


def recovery_sketch(
    problem: RecoverProblem, task: Task, solutions: Mapping[str, Solution]
) -> Sequence[HeatMaps]:
    """Return for each layer its true covariance and the estimates of all that have one."""
    return [_figure(problem, task, solutions, layer) for layer in reversed(LAYERS)]


def _figure(
    problem: RecoverProblem, task: Task, solutions: Mapping[str, Solution], layer: str
) -> HeatMaps:
    name = f"covariance-{layer}"
    found = {label: each[name] for label, each in solutions.items() if name in each}
    shown = {"truth": problem.truth[layer], **found}
    channels, n_points = problem.train[0].channels, len(problem.times[::EVERY])
    return HeatMaps(
        task=task.name,
        title=TITLES[layer],
        caption=(
            "the true covariance of the curves and the estimates, without noise. Within a block "
            "time runs from left to right and from top to bottom."
        ),
        labels=tuple(np.repeat(channels, n_points).tolist()),
        maps=tuple(
            HeatMap(label, _thinned(covariance, len(channels)))
            for label, covariance in shown.items()
        ),
        limit=float(np.abs(problem.truth[layer]).max()),
        columns=3,
    )


def _thinned(covariance: NDArray[np.float64], n_outputs: int) -> NDArray[np.float64]:
    """Return the covariance at every so many points of each output."""
    kept = np.arange(len(covariance)).reshape(n_outputs, -1)[:, ::EVERY].ravel()
    return covariance[np.ix_(kept, kept)]
