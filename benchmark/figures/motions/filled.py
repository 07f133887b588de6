"""Filled recordings beside the truth, to be played."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.figures.motions.chosen import Chosen, chosen
from mocapbench.benchmark.figures.motions.placing import PlacesJoints, placed
from mocapbench.benchmark.figures.motions.side_view import side_view
from mocapbench.benchmark.figures.motions.window import shown_frames
from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.impute import FilledRecordings, ImputeProblem
from mocapbench.datasets import Recording
from mocapbench.reports import Motion, Motions

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
        A sentence to add to the caption.
    """

    n_most: int = 8
    body: Callable[[FilledProblem], PlacesJoints | None] = body_of_problem
    remark: str = ""

    def pictures(self, solved: FilledProblem, /) -> Sequence[Motions]:
        """Return one player; none if no body is known, or part of the truth is not."""
        body, given, truth = self.body(solved), solved.problem.given[0], solved.problem.truth[0]
        if body is None or not np.isfinite(truth).all():
            return ()
        entrants, hidden = chosen(solved, self.n_most), (~given.visible).any(axis=1)
        means = [solved.answers[label].predictions[0].mean for label in entrants.labels]
        filled = [np.where(given.visible, truth, mean) for mean in means]
        joints = tuple(segment.name for segment in body.skeleton.segments)
        first, *others = placed(body, given, [truth, *filled])
        rows = shown_frames(given.times, hidden)
        shown, *motions = side_view(first[rows], [other[rows] for other in others], joints)
        pairs = zip(entrants.labels, motions, strict=True)
        return (
            Motions(
                task=solved.task,
                title="Motion",
                caption=" ".join(filter(None, (_caption(given, rows, entrants), self.remark))),
                interval=float(np.diff(given.times[rows]).mean()),
                joints=joints,
                parents=body.skeleton.parents,
                hidden=hidden[rows],
                truths={"truth": shown},
                motions=tuple(Motion(label, positions) for label, positions in pairs),
                beside=entrants.beside,
            ),
        )


def _caption(given: Recording, rows: NDArray[np.intp], entrants: Chosen) -> str:
    shown, rate = given.times[rows], 1.0 / np.diff(given.times[rows]).mean()
    cut = shown[-1] - shown[0] < 0.99 * (given.times[-1] - given.times[0])
    part = f"{shown[-1] - shown[0]:.1f} s around the first gap" if cut else "the whole recording"
    return (
        f"{given.name}, {part} at {rate:.0f} frames per second. {entrants.phrase}. Frames of which "
        "something is hidden are shaded; what is visible of them is as recorded."
    )
