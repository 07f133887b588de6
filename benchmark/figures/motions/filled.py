"""Filled recordings beside the truth, to be played."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mocapbench.benchmark.figures.motions.chosen import choose_entrants
from mocapbench.benchmark.figures.motions.placing import PlacesJoints, place_joints
from mocapbench.benchmark.figures.motions.played import Pair, build_player
from mocapbench.benchmark.figures.motions.window import ShownWindow
from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.impute import FilledRecordings, ImputeProblem
from mocapbench.reports import Motions

__all__ = ["FilledMotion", "body_of_problem"]

FilledProblem = Solved[ImputeProblem, FilledRecordings]


def body_of_problem(solved: FilledProblem) -> PlacesJoints | None:
    """Return the body that the problem states."""
    return solved.problem.body


@dataclass(frozen=True)
class FilledMotion:
    """The first recording of a problem, and what entrants made of its hidden entries.

    Parameters
    ----------
    n_most : int
        How many entrants to show, best first by the task's first metric.
    body : callable
        ``body(solved)`` is the body that moves, or None.
    remark : str
        A sentence to add to the caption, with a blank before it.
    """

    n_most: int = 8
    body: Callable[[FilledProblem], PlacesJoints | None] = body_of_problem
    remark: str = ""

    def pictures(self, solved: FilledProblem, /) -> Sequence[Motions]:
        """Return one player; none if no body is known, or part of the truth shown is not."""
        body, given = self.body(solved), solved.problem.given[0]
        window = ShownWindow(given.times, np.asarray((~given.visible).any(axis=1)))
        shown, truth = given.frames(np.r_[window.part]), solved.problem.truth[0][window.part]
        if body is None or not np.isfinite(truth).all():
            return ()
        entrants = choose_entrants(solved, self.n_most)
        means = [solved.answers[label].predictions[0].mean for label in entrants.labels]
        filled = [np.where(shown.visible, truth, mean[window.part]) for mean in means]
        true, *made = place_joints(body, shown, [truth, *filled])
        pairs = [Pair("truth", true, positions) for positions in made]
        caption = f"{given.name}, shaded where something is hidden.{self.remark}"
        return (
            build_player(solved, body, window, entrants=entrants, pairs=pairs, caption=caption),
        )
