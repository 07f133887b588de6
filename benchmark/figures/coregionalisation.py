"""Estimated coregionalisation matrices, layer by layer and component: thesis Figures 14–16."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.problems.base import Problem, Solution
from mocapbench.benchmark.tasks.base import Task
from mocapbench.reports import HeatMap, HeatMaps

__all__ = ["coregionalisation_sketch"]


def coregionalisation_sketch(
    problem: Problem, task: Task, solutions: Mapping[str, Solution]
) -> Sequence[HeatMaps]:
    """Return the matrices of each entrant that the task names: of all joints, and of groups."""
    channels = problem.train[0].channels
    return [
        figure
        for label in task.coregionalisation_of
        if label in solutions
        for figure in _figures(task, label, channels, dict(_layers(solutions[label])))
    ]


def _figures(
    task: Task, label: str, channels: Sequence[str], layers: Mapping[str, NDArray[np.float64]]
) -> Iterator[HeatMaps]:
    joints = [channel.partition(".")[0] for channel in channels]
    yield _figure(task, f"{label}, all joints", joints, layers)
    for title, group in task.joint_groups.items():
        chosen = [place for place, joint in enumerate(joints) if joint in group]
        names = [channels[place] for place in chosen]
        parts = {name: matrices[:, chosen][:, :, chosen] for name, matrices in layers.items()}
        yield _figure(task, f"{label}, {title}", names, parts)


def _figure(
    task: Task, of: str, labels: Sequence[str], layers: Mapping[str, NDArray[np.float64]]
) -> HeatMaps:
    return HeatMaps(
        task=task.name,
        title=f"Coregionalisation by {of}",
        caption=(
            "the matrices B of each layer and component, over the roots of the layer's variances, "
            "so that the components of a layer add up to its matrix of correlations."
        ),
        labels=tuple(labels),
        maps=tuple(
            HeatMap(f"{layer}, component {q}", matrix)
            for layer, matrices in layers.items()
            for q, matrix in enumerate(matrices, start=1)
        ),
        limit=1.0,
        columns=max(map(len, layers.values())),
    )


def _layers(solution: Solution) -> Iterator[tuple[str, NDArray[np.float64]]]:
    """Yield the layers' names and their matrices (Q, D, D) in shares of the layer's variances."""
    for name, matrices in solution.items():
        kind, _, layer = name.partition("-")
        if kind == "coregionalisation":
            scale = np.sqrt(np.diagonal(matrices.sum(axis=0)))
            yield layer, matrices / np.outer(scale, scale)
