"""True and estimated covariances side by side.

After J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017, Figures 11–13.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.recover import LAYERS, Covariances, RecoverProblem
from mocapbench.reports import HeatMaps

__all__ = ["draw_covariances"]

EVERY = 2
"""Every so many points are drawn."""
TITLES = {
    "parent": "Covariance of the parent, K_g",
    "child": "Covariance of the children, K_f",
}


def draw_covariances(solved: Solved[RecoverProblem, Covariances], /) -> Sequence[HeatMaps]:
    """Return for each layer its true covariance, and the estimates of all entrants that have one.

    One picture per layer, the innermost first.
    """
    return [_picture(solved, layer) for layer in reversed(LAYERS)]


def _picture(solved: Solved[RecoverProblem, Covariances], layer: str) -> HeatMaps:
    problem = solved.problem
    estimates = {
        label: solution[layer] for label, solution in solved.solutions.items() if layer in solution
    }
    channels, n_points = problem.train[0].channels, len(problem.times[::EVERY])
    return HeatMaps(
        task=solved.task,
        title=TITLES[layer],
        caption=(
            "the true covariance of the curves and the estimates, without noise. Within a block "
            "time runs from left to right and from top to bottom."
        ),
        labels=tuple(np.repeat(channels, n_points).tolist()),
        maps={
            label: _thin_covariance(covariance, len(channels))
            for label, covariance in {"truth": problem.truth[layer], **estimates}.items()
        },
        limit=float(np.abs(problem.truth[layer]).max()),
        columns=3,
    )


def _thin_covariance(covariance: NDArray[np.float64], n_outputs: int) -> NDArray[np.float64]:
    """Return the covariance at every so many points of each output."""
    kept = np.arange(len(covariance)).reshape(n_outputs, -1)[:, ::EVERY].ravel()
    return covariance[np.ix_(kept, kept)]
