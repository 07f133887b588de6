"""What one entrant made, as a recording and as a picture that moves."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import singledispatch
from typing import Any

import numpy as np

from mocapbench.baselines import SampleByFrameByChannel
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.figures.motions.filled import draw_filled_motion
from mocapbench.benchmark.figures.motions.sampled import draw_sampled_motion
from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.problems.body import JointAngles
from mocapbench.benchmark.problems.impute import ImputeProblem, Predictions
from mocapbench.benchmark.problems.synthesise import SynthesiseProblem
from mocapbench.benchmark.tasks.base import Task
from mocapbench.datasets import Recording, Skeleton
from mocapbench.reports import Motions

__all__ = ["MadeMotion", "entrant_motion"]


MadeMotion = tuple[Recording, Skeleton | None, Motions | None]
"""The first recording that an entrant filled, or its first sample; with the skeleton of which the
channels are joint angles, and the picture beside the truth, where there are any."""


def entrant_motion(task: Task, solved: Solved[Any, Any]) -> MadeMotion:
    """Return what the only entrant of a solved problem made.

    Raises
    ------
    UsageError
        If the problem is neither to fill nor to invent motion.
    """
    ((label, solution),) = solved.solutions.items()
    recording, figure = _make_motion(solved.problem, solution)
    on_page: Iterable[Callable[..., Any]] = task.page.figures
    same = (f for f in on_page if getattr(f, "func", f) is figure)  # perhaps a partial
    pictures: Sequence[Motions] = next(same, figure)(solved)
    body = solved.problem.body
    skeleton = body.skeleton if isinstance(body, JointAngles) else None
    named = replace(recording, name=f"{recording.name}, {label}")
    return named, skeleton, pictures[0] if pictures else None


@singledispatch
def _make_motion(problem: Problem[Any], solution: Any) -> tuple[Recording, Callable[..., Any]]:
    """Return what was made, and the figure that shows it."""
    del solution
    raise UsageError(
        "expected a task that fills or invents motion, got one that does not "
        f"({type(problem).__name__})"
    )


@_make_motion.register(ImputeProblem)
def _fill_recording(
    problem: ImputeProblem, solution: Predictions
) -> tuple[Recording, Callable[..., Any]]:
    given, mean = problem.given[0], solution[0].mean
    return given.with_values(np.where(given.visible, given.values, mean)), draw_filled_motion


@_make_motion.register(SynthesiseProblem)
def _sample_motion(
    problem: SynthesiseProblem, solution: SampleByFrameByChannel
) -> tuple[Recording, Callable[..., Any]]:
    sample = replace(problem.train[0], times=problem.times, values=solution[0])
    return sample, draw_sampled_motion
