"""What one entrant made, as a recording and as a picture that moves."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import singledispatch
from typing import Any

import numpy as np

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.figures.motions.filled import FilledMotion
from mocapbench.benchmark.figures.motions.sampled import SampledMotion
from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.problems.body import JointAngles
from mocapbench.benchmark.problems.impute import FilledRecordings, ImputeProblem
from mocapbench.benchmark.problems.synthesise import Samples, SynthesiseProblem
from mocapbench.benchmark.tasks.base import Task
from mocapbench.datasets import Recording, Skeleton
from mocapbench.reports import Motions

__all__ = ["EntrantMotion", "entrant_motion"]


@dataclass(frozen=True, eq=False)
class EntrantMotion:
    """What one entrant made: the first recording that it filled, or its first sample.

    Parameters
    ----------
    recording : Recording
        Visible entries are as recorded.
    skeleton : Skeleton or None
        Of which the channels are joint angles; None where they are not.
    picture : Motions or None
        Beside the truth; None where joints have no positions.
    """

    recording: Recording
    skeleton: Skeleton | None
    picture: Motions | None


def entrant_motion(task: Task, solved: Solved[Any, Any]) -> EntrantMotion:
    """Return what the only entrant of a solved problem made.

    Raises
    ------
    UsageError
        If the problem is neither to fill nor to invent motion.
    """
    ((label, answer),) = solved.answers.items()
    recording, figure = _make_motion(solved.problem, answer)
    figures = [f for f in task.page.figures if isinstance(f, type(figure))] or [figure]
    pictures = figures[0].pictures(solved)
    body = solved.problem.body
    skeleton = body.skeleton if isinstance(body, JointAngles) else None
    named = replace(recording, name=f"{recording.name}, {label}")
    return EntrantMotion(named, skeleton, pictures[0] if pictures else None)


@singledispatch
def _make_motion(
    problem: Problem[Any], answer: Any
) -> tuple[Recording, FilledMotion | SampledMotion]:
    """Return what was made, and the figure that shows it."""
    del answer
    raise UsageError(
        "expected a task that fills or invents motion, got one that does not "
        f"({type(problem).__name__})"
    )


@_make_motion.register
def _fill_recording(
    problem: ImputeProblem, answer: FilledRecordings
) -> tuple[Recording, FilledMotion | SampledMotion]:
    given, mean = problem.given[0], answer.predictions[0].mean
    return given.with_values(np.where(given.visible, given.values, mean)), FilledMotion()


@_make_motion.register
def _sample_motion(
    problem: SynthesiseProblem, answer: Samples
) -> tuple[Recording, FilledMotion | SampledMotion]:
    sample = replace(problem.train[0], times=problem.times, values=answer.values[0])
    return sample, SampledMotion()
