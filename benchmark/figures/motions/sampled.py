"""Invented motions beside the recordings that they resemble, to be played."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.linalg import norm

from mocapbench.benchmark.figures.motions.placing import on_the_spot, place_joints
from mocapbench.benchmark.figures.motions.played import (
    Pair,
    build_player,
    choose_entrants,
    shown_part,
)
from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.synthesise import SynthesiseProblem
from mocapbench.datasets import FrameByJointBy3
from mocapbench.reports import Motions

if TYPE_CHECKING:
    from mocapbench.baselines import SampleByFrameByChannel

__all__ = ["draw_sampled_motion"]


def draw_sampled_motion(
    solved: Solved[SynthesiseProblem, SampleByFrameByChannel], /, n_most: int = 8
) -> Sequence[Motions]:
    """Return the first sample of each entrant, and the reference that it resembles best.

    One player; none if the problem states no body.

    Parameters
    ----------
    solved : Solved
    n_most : int
        How many entrants to show, best first by the task's first metric.
    """
    problem, body = solved.problem, solved.problem.body
    if body is None:
        return ()
    entrants = choose_entrants(solved, n_most)
    whole = replace(problem.train[0], times=problem.times, values=problem.references[0])
    part = shown_part(whole)
    samples = [solved.solutions[label][0] for label in entrants[0]]
    values = [motion[part] for motion in (*problem.references, *samples)]
    like = whole.frames(np.r_[part])
    motions = [on_the_spot(motion) for motion in place_joints(body, like, values)]
    references, made = motions[: -len(samples)], motions[-len(samples) :]
    pairs = [_beside_nearest(sample, references) for sample in made]
    caption = (
        f"The first sample of each entrant, beside the reference, of {len(references)}, whose "
        f"joints are nearest on average; all on the body of {like.name}, without the path on "
        "the floor."
    )
    return (build_player(solved, body, whole, entrants=entrants, pairs=pairs, caption=caption),)


def _beside_nearest(sample: FrameByJointBy3, references: Sequence[FrameByJointBy3]) -> Pair:
    """Return a sample and the reference of least mean distance of joints, frame by frame."""
    distances = [norm(sample - reference, axis=-1).mean() for reference in references]
    nearest = int(np.argmin(distances))
    return f"reference {nearest + 1}", references[nearest], sample
