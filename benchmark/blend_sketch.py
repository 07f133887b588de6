"""A passage between two styles, as stick figures and as curves: HLM Figure 3."""

from __future__ import annotations

from collections import Counter

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.clustering import ClusterProblem
from mocapbench.benchmark.problem import Solution
from mocapbench.benchmark.task import Task
from mocapbench.datasets import (
    Recording,
    Skeleton,
    integrate_root,
    joint_positions,
)
from mocapbench.reports import Curve, Illustration, Panel

__all__ = ["blend_sketch"]

N_FIGURES = 8
STRIDE = 90.0
"""Centimetres from one stick figure to the next."""
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
    panels = (_strip(motion, problem.skeleton), *curves)
    return Illustration(task.name, f"Blend by {label}", caption, panels)


def _name(problem: ClusterProblem, solution: Solution, cluster: int) -> str:
    """Return the cluster's number and what most of its recordings are."""
    members = np.flatnonzero(solution["labels"] == cluster)
    styles = Counter(problem.truth[k] for k in members)
    return f"cluster {cluster} ({styles.most_common(1)[0][0]})"


def _strip(motion: Recording, skeleton: Skeleton) -> Panel:
    """Return stick figures at even times, seen from the side and set apart."""
    frames = np.linspace(0, len(motion.times) - 1, N_FIGURES).round().astype(int)
    places = joint_positions(skeleton, integrate_root(motion).frames(frames))
    places = places - places[:, :1] * [0.0, 0.0, 1.0]
    places[..., 1] -= places[..., 1].min(axis=1, keepdims=True)
    places[..., 2] += STRIDE * np.arange(N_FIGURES)[:, None]
    return Panel(
        f"every {np.diff(motion.times[frames]).mean():.2g} s",
        "",
        "height, cm",
        tuple(_sticks(skeleton, figure) for figure in places),
        spatial=True,
    )


def _sticks(skeleton: Skeleton, joints: NDArray[np.float64]) -> Curve:
    """Return the bones between joints (J, 3) as one broken line."""
    ends = joints[1:]
    starts = joints[list(skeleton.parents[1:])]
    line = np.stack([starts, ends, np.full_like(ends, np.nan)], axis=1).reshape(-1, 3)
    return Curve(line[:, 2], line[:, 1], PASSAGE)
