"""Latent spaces of three dimensions, and walks through them: GPDM Figures 3 to 11."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from mocapbench.benchmark.figures.stick_figures import strip
from mocapbench.benchmark.problems.base import Problem, Solution
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.tasks.base import Task
from mocapbench.datasets import Recording
from mocapbench.reports import Illustration, Path3D, Picture, Space

__all__ = ["latent_sketch"]

TRAINING, MEAN, SAMPLE = "training", "mean prediction", "fair sample"


def latent_sketch(
    problem: Problem, task: Task, solutions: Mapping[str, Solution]
) -> Sequence[Picture]:
    """Return the latent space of each entrant that the task names, then walks through them."""
    told = {label: solutions[label] for label in task.latent_of if label in solutions}
    spaces = [
        _space(task, label, solution)
        for label, solution in told.items()
        if "latent-cloud" in solution
    ]
    return [*spaces, *_walks(problem, task, told)]


def _space(task: Task, label: str, solution: Solution) -> Space:
    found = {
        name.removeprefix("property-"): float(value)
        for name, value in solution.items()
        if name.startswith("property-")
    }
    listed = ", ".join(f"{name} {value:.3g}" for name, value in found.items())
    caption = (
        f"latent positions of the training frames by {label}, and the confidence −ln σ² with "
        f"which poses are reconstructed around them{_walked(solution)}. Kernels: {listed}."
    )
    cloud = np.asarray(solution["latent-cloud"], dtype=np.float64)
    return Space(
        task.name,
        f"Latent space of {label}",
        caption,
        tuple(_paths(solution)),
        cloud[:, :3],
        cloud[:, 3],
        "−ln σ²",
    )


def _walked(solution: Solution) -> str:
    if "latent-mean" not in solution:
        return ""
    n_frames = len(solution["latent-mean"])
    return f"; the mean prediction and fair samples of {n_frames} frames from the first one"


def _paths(solution: Solution) -> Iterator[Path3D]:
    groups = {"latent-path": TRAINING, "latent-sample": SAMPLE, "latent-mean": MEAN}
    for prefix, group in groups.items():
        for name, points in solution.items():
            if name.startswith(prefix):
                yield Path3D(points, group)


def _walks(problem: Problem, task: Task, told: Mapping[str, Solution]) -> Sequence[Illustration]:
    """Return stick figures of the mean prediction and of a fair sample of each entrant."""
    walking = {label: solution for label, solution in told.items() if "walk-mean" in solution}
    if not isinstance(problem, ImputeProblem) or problem.skeleton is None or not walking:
        return ()
    about = problem.train[0]
    step = float(np.diff(about.times).mean())
    longest = max(len(solution["walk-mean"]) for solution in walking.values())
    times = np.linspace(0.0, step * (longest - 1), longest)
    panels = tuple(
        strip(
            Recording(label, times[: len(walk)], walk, about.channels, about.units),
            problem.skeleton,
            group,
            f"{label}: {group}, ",
        )
        for label, solution in walking.items()
        for walk, group in ((solution["walk-mean"], MEAN), (solution["walk-sample"], SAMPLE))
    )
    caption = (
        "mean poses along the mean prediction and along one fair sample of the latent dynamics, "
        "from the first training frame."
    )
    return (Illustration(task.name, "Motions from the dynamics", caption, panels),)
