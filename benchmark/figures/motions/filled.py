"""Filled recordings beside the truth, to be played."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from mocapbench.benchmark.figures.motions.placing import PlacesJoints, place_joints
from mocapbench.benchmark.figures.motions.played import build_player, choose_entrants, shown_part
from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.impute import ImputeProblem, Predictions
from mocapbench.datasets import FrameByChannel
from mocapbench.reports import Motions

__all__ = ["body_of_problem", "draw_filled_motion"]

FilledProblem = Solved[ImputeProblem, Predictions]


def body_of_problem(solved: FilledProblem) -> PlacesJoints | None:
    """Return the body that the problem states."""
    return solved.problem.body


def draw_filled_motion(
    solved: FilledProblem,
    /,
    n_most: int = 8,
    find_body: Callable[[FilledProblem], PlacesJoints | None] = body_of_problem,
    remark: str = "",
) -> Sequence[Motions]:
    """Return the first recording of a problem, and what entrants made of its hidden entries.

    One player; none if no body is known, or of the truth shown more than single frames is not,
    which are drawn halfway between their neighbours.

    Parameters
    ----------
    solved : Solved
    n_most : int
        How many entrants to show, best first by the task's first metric.
    find_body : callable
        ``find_body(solved)`` is the body that moves, or None.
    remark : str
        A sentence to add to the caption, with a blank before it.
    """
    body, given = find_body(solved), solved.problem.given[0]
    part = shown_part(given)
    shown, truth = given.frames(np.r_[part]), _complete_frames(solved.problem.truth[0][part])
    if body is None or truth is None:
        return ()
    entrants = choose_entrants(solved, n_most)
    means = [solved.solutions[label][0].mean for label in entrants[0]]
    filled = [np.where(shown.visible, truth, mean[part]) for mean in means]
    true, *made = place_joints(body, shown, [truth, *filled])
    pairs = [("truth", true, positions) for positions in made]
    caption = f"{given.name}, shaded where something is hidden.{remark}"
    return (build_player(solved, body, given, entrants=entrants, pairs=pairs, caption=caption),)


def _complete_frames(truth: FrameByChannel) -> FrameByChannel | None:
    """Return a truth with its single unknown frames interpolated; None if more is unknown."""
    unknown = np.asarray(~np.isfinite(truth).all(axis=1))
    if unknown[[0, -1]].any() or (unknown[1:] & unknown[:-1]).any():
        return None
    frames, complete = np.flatnonzero(unknown), truth.copy()
    complete[frames] = (truth[frames - 1] + truth[frames + 1]) / 2
    return complete
