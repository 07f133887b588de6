"""Invented motions beside the recordings that they resemble, to be played."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.linalg import norm

from mocapbench.benchmark.figures.motions.chosen import chosen
from mocapbench.benchmark.figures.motions.placing import on_the_spot, placed
from mocapbench.benchmark.figures.motions.played import Pair, Timing, played
from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.synthesise import Samples, SynthesiseProblem
from mocapbench.datasets import FrameByJointBy3
from mocapbench.reports import Motions

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
        problem, body = solved.problem, solved.problem.body
        if body is None:
            return ()
        entrants = chosen(solved, self.n_most)
        like = replace(problem.train[0], times=problem.times, values=problem.references[0])
        samples = [solved.answers[label].values[0] for label in entrants.labels]
        motions = placed(body, like, [*problem.references, *samples])
        on_spot = [on_the_spot(motion) for motion in motions]
        references = on_spot[: len(problem.references)]
        pairs = [_beside_nearest(made, references) for made in on_spot[len(references) :]]
        timing = Timing(problem.times, np.zeros(len(problem.times), dtype=bool))
        caption = (
            f"The first sample of each entrant, beside the reference, of {len(references)}, whose "
            f"joints are nearest on average; all on the body of {like.name}, without the path on "
            "the floor."
        )
        return (played(solved, body, timing, entrants=entrants, pairs=pairs, caption=caption),)


def _beside_nearest(sample: FrameByJointBy3, references: Sequence[FrameByJointBy3]) -> Pair:
    """Return a sample and the reference of least mean distance of joints, frame by frame."""
    distances = [norm(sample - reference, axis=-1).mean() for reference in references]
    nearest = int(np.argmin(distances))
    return Pair(f"reference {nearest + 1}", references[nearest], sample)
