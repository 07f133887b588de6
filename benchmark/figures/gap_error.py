"""The error along a gap of whole hidden frames."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.linalg import norm

from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.impute import ImputeProblem, Predictions
from mocapbench.reports import Axes, Curve, Illustration

__all__ = ["draw_gap_error"]


def draw_gap_error(
    solved: Solved[ImputeProblem, Predictions], /, n_best: int = 5
) -> Sequence[Illustration]:
    """Return the norm of the error at every hidden frame, of the entrants with the least mean.

    One picture of the first recording; none if no whole frame is hidden.

    Parameters
    ----------
    solved : Solved
    n_best : int
        How many entrants to show.
    """
    recording, truth = solved.problem.given[0], solved.problem.truth[0]
    hidden = ~recording.visible.any(axis=1)
    if not hidden.any():
        return ()
    errors = {
        label: np.asarray(norm((solution[0].mean - truth)[hidden], axis=1))
        for label, solution in solved.solutions.items()
    }
    best = sorted(errors, key=lambda label: float(errors[label].mean()))[:n_best]
    frames = np.asarray(np.flatnonzero(hidden) + 1, dtype=np.float64)
    curves = tuple(Curve(frames, errors[label], label) for label in best)
    caption = (
        f"{recording.name}: the Euclidean norm of the error over all channels at every hidden "
        f"frame, of the {len(best)} entrants with the least mean in this window."
    )
    panel = Axes("all channels", "frame", "error per frame", curves)
    return (Illustration(solved.task, "Error along the gap", caption, (panel,)),)
