"""Invented motions beside the recordings that they resemble, to be played."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.linalg import norm

from mocapbench.benchmark.figures.motions.chosen import chosen
from mocapbench.benchmark.figures.motions.placing import on_the_spot, placed
from mocapbench.benchmark.figures.motions.side_view import side_view
from mocapbench.benchmark.figures.motions.window import shown_frames
from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.synthesise import Samples, SynthesiseProblem
from mocapbench.datasets import FrameByJointBy3
from mocapbench.reports import Motion, Motions

__all__ = ["SampledMotion"]


@dataclass(frozen=True)
class SampledMotion:
    """The first sample of each entrant, and the reference that it resembles best.

    Parameters
    ----------
    n_most : int
        How many entrants to show, best first by the task's first metric.
    """

    n_most: int = 8

    def pictures(self, solved: Solved[SynthesiseProblem, Samples], /) -> Sequence[Motions]:
        """Return one player; none if the problem states no body."""
        problem, entrants = solved.problem, chosen(solved, self.n_most)
        if problem.body is None:
            return ()
        joints = tuple(segment.name for segment in problem.body.skeleton.segments)
        like = replace(problem.train[0], times=problem.times, values=problem.references[0])
        samples = [solved.answers[label].values[0] for label in entrants.labels]
        hidden = np.zeros(len(problem.times), dtype=bool)
        rows = shown_frames(problem.times, hidden)
        motions = [
            on_the_spot(motion)[rows]
            for motion in placed(problem.body, like, [*problem.references, *samples])
        ]
        references, invented = motions[: -len(samples)], motions[-len(samples) :]
        nearest = [_nearest(motion, references) for motion in invented]
        names = {k: f"reference {k + 1}" for k in sorted({*nearest})}
        seen = [
            side_view(references[k], [m], joints) for k, m in zip(nearest, invented, strict=True)
        ]
        return (
            Motions(
                task=solved.task,
                title="Motion",
                caption=(
                    f"{entrants.phrase}: the first sample of each, beside the one of "
                    f"{len(references)} references whose joints are nearest on average, all on the "
                    f"body of {like.name} and without the path on the floor."
                ),
                interval=float(np.diff(problem.times[rows]).mean()),
                joints=joints,
                parents=problem.body.skeleton.parents,
                hidden=hidden[rows],
                truths={names[k]: pair[0] for k, pair in zip(nearest, seen, strict=True)},
                motions=tuple(
                    Motion(label, pair[1], names[k])
                    for label, k, pair in zip(entrants.labels, nearest, seen, strict=True)
                ),
                beside=entrants.beside,
            ),
        )


def _nearest(motion: FrameByJointBy3, references: Sequence[FrameByJointBy3]) -> int:
    """Return which reference has the least mean distance of joints, frame by frame."""
    distances = [norm(motion - reference, axis=-1).mean() for reference in references]
    return int(np.argmin(distances))
