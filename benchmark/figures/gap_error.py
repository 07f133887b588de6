"""The error along a gap of whole hidden frames, by how far it is from the frames beside."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.linalg import norm

from mocapbench.benchmark.problems.base import Problem, Solution
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.tasks.base import Task
from mocapbench.reports import Curve, Illustration, Panel

__all__ = ["gap_sketch"]

N_BEST = 5


def gap_sketch(
    problem: Problem, task: Task, solutions: Mapping[str, Solution]
) -> Sequence[Illustration]:
    """Return the norm of the error at every hidden frame, of the best entrants of this fold."""
    if not isinstance(problem, ImputeProblem):
        return ()
    recording, truth = problem.given[0], problem.truth[0]
    hidden = ~recording.visible.any(axis=1)
    if not hidden.any():
        return ()
    errors = {
        label: np.asarray(norm((solution["mean-0"] - truth)[hidden], axis=1), np.float64)
        for label, solution in solutions.items()
    }
    best = sorted(errors, key=lambda label: float(errors[label].mean()))[:N_BEST]
    frames = np.asarray(np.flatnonzero(hidden) + 1, dtype=np.float64)
    curves = tuple(Curve(frames, errors[label], label) for label in best)
    caption = (
        f"{recording.name}, the Euclidean norm of the error over all channels at every hidden "
        f"frame, of the {len(best)} entrants with the least mean in this window."
    )
    panel = Panel("all channels", "frame", "error per frame", curves)
    return (Illustration(task.name, "Error along the gap", caption, (panel,)),)
