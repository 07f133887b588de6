"""A passage between two styles, as stick figures and as curves: HLM Figure 3."""

from __future__ import annotations

from collections import Counter

import numpy as np

from mocapbench.benchmark.figures.stick_figures import strip
from mocapbench.benchmark.problems.base import Solution
from mocapbench.benchmark.problems.cluster import ClusterProblem
from mocapbench.benchmark.tasks.base import Task
from mocapbench.datasets import Recording
from mocapbench.reports import Curve, Illustration, Panel

__all__ = ["blend_sketch"]

PASSAGE = "passage"


def blend_sketch(
    problem: ClusterProblem, task: Task, label: str, solution: Solution
) -> Illustration:
    """Return stick figures of the passage, and some of its channels between those of the styles."""
    names = [_name(problem, solution, cluster) for cluster in solution["blended"]]
    first, between, second = solution["blend"]
    recording = problem.train[0]
    times = np.arange(len(between)) * np.diff(recording.times).mean()
    columns = [recording.channels.index(channel) for channel in task.illustrated_channels]
    curves = tuple(
        Panel(
            recording.channels[column],
            "time, s",
            recording.units[column],
            tuple(
                Curve(times, motion[:, column], group)
                for motion, group in (
                    (between, PASSAGE),
                    (first, names[0]),
                    (second, names[1]),
                )
            ),
        )
        for column in columns
    )
    motion = Recording("passage", times, between, recording.channels, recording.units)
    caption = (
        f"a passage from {names[0]} to {names[1]}: the mean cycles of two styles of {label}, mixed "
        "by a weight that varies smoothly from one to the other. Clusters are called after most of "
        "their recordings. A style’s curves are jagged where unlike recordings share it: one that "
        "advances two or three states a frame leaves out those between, which another then takes."
    )
    panels = (strip(motion, problem.skeleton, PASSAGE), *curves)
    return Illustration(task.name, f"Blend by {label}", caption, panels)


def _name(problem: ClusterProblem, solution: Solution, cluster: int) -> str:
    """Return the cluster's number and what most of its recordings are."""
    members = np.flatnonzero(solution["labels"] == cluster)
    styles = Counter(problem.truth[k] for k in members)
    return f"cluster {cluster} ({styles.most_common(1)[0][0]})"
