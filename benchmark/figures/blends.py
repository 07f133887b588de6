"""A transition between two styles as stick figures and curves: Pan and Torresani 2009, Figure 3."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.figures.stick_figures import strip
from mocapbench.benchmark.problems.body import JointAngles
from mocapbench.benchmark.problems.cluster import ClusterProblem, Clusters
from mocapbench.datasets import Recording
from mocapbench.reports import Axes, Curve, Illustration

__all__ = ["draw_blends"]

TRANSITION = "transition"


def draw_blends(
    solved: Solved[ClusterProblem, Clusters], /, channels: tuple[str, ...]
) -> Sequence[Illustration]:
    """Return stick figures of each transition between two styles, and its channels beside theirs.

    One picture per model that blends.

    Parameters
    ----------
    solved : Solved
    channels : tuple of str
    """
    return [
        _picture(solved, label, solution, channels)
        for label, solution in solved.solutions.items()
        if solution.blend is not None
    ]


def _picture(
    solved: Solved[ClusterProblem, Clusters],
    label: str,
    solution: Clusters,
    channels: Sequence[str],
) -> Illustration:
    problem, blend = solved.problem, solution.blend
    assert blend is not None
    first, second = (_name(problem, solution, cluster) for cluster in blend["blended"].tolist())
    one, between, other = blend["blend"]
    recording = problem.train[0]
    times = np.arange(len(between)) * np.diff(recording.times).mean()
    motion = Recording(TRANSITION, times, between, recording.channels, recording.units)
    groups = {TRANSITION: between, first: one, second: other}
    curves = [_panel(motion, channel, groups) for channel in channels]
    caption = (
        f"a transition from {first} to {second}: the mean cycles of two styles of {label}, "
        "mixed by a weight that changes smoothly from one to the other. A cluster is named "
        "after the style of most of its recordings. Curves of a style are jagged where unlike "
        "recordings share it: one that advances two or three states a frame skips those "
        "between, which another recording then shapes."
    )
    moving = strip(motion, JointAngles(problem.skeleton), [TRANSITION] * len(times))
    panels = (moving, *curves)
    return Illustration(solved.task, f"Blend by {label}", caption, panels)


def _panel(motion: Recording, channel: str, values: dict[str, np.ndarray]) -> Axes:
    column = motion.channels.index(channel)
    curves = (Curve(motion.times, array[:, column], group) for group, array in values.items())
    return Axes(channel, "time, s", motion.units[column], tuple(curves))


def _name(problem: ClusterProblem, solution: Clusters, cluster: int) -> str:
    """Return the cluster's number and the style of most of its recordings."""
    members = np.flatnonzero(solution.labels == cluster)
    styles = Counter(problem.truth[k] for k in members)
    return f"cluster {cluster} ({styles.most_common(1)[0][0]})"
