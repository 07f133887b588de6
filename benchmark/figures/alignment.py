"""Recordings before and after alignment, after Pan and Torresani 2009 (HLM), Figure 1."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.arrays import Arrays, arrays_by_number
from mocapbench.benchmark.problems.cluster import ClusterProblem, Clusters
from mocapbench.reports import Axes, Curve, Illustration

if TYPE_CHECKING:
    from mocapbench.baselines import StatePath

__all__ = ["draw_alignments"]


def draw_alignments(solved: Solved[ClusterProblem, Clusters], /) -> Sequence[Illustration]:
    """Return the second principal component over time, and over the cycle of models that align.

    One picture: a panel as recorded, then one per model that aligns.
    """
    problem = solved.problem
    component = _second_component([recording.values for recording in problem.train])
    recorded = [recording.times - recording.times[0] for recording in problem.train]
    panels = [_panel("as recorded", "time, s", recorded, component, problem.truth)]
    for label, solution in solved.solutions.items():
        if solution.alignment is not None:
            cycles = _cycles(solution.alignment)
            title = f"aligned by {label}"
            panels.append(_panel(title, "cycles", cycles, component, problem.truth))
    caption = (
        "the second principal component of every recording, first over time and then over the "
        "states of the common cycle with which each model aligned its frames. Styles are those "
        "of the labels, which no model saw."
    )
    title = "Before and after alignment"
    return (Illustration(solved.task, title, caption, tuple(panels)),)


def _panel(
    title: str, x_label: str, x: Sequence[Array], y: Sequence[Array], styles: Sequence[str]
) -> Axes:
    return Axes(title, x_label, "2nd component", tuple(map(Curve, x, y, styles)))


def _second_component(recordings: Sequence[Array]) -> list[Array]:
    """Return the second principal component (N_k,) of each of ``recordings`` (N_k, D)."""
    # Imported where it is used: a task names this figure, and lists of tasks draw none.
    from sklearn.decomposition import PCA  # noqa: PLC0415

    analysis = PCA(n_components=2, svd_solver="full").fit(np.concatenate(recordings))
    return [analysis.transform(values)[:, 1] for values in recordings]


def _cycles(alignment: Arrays) -> list[Array]:
    n_states = int(alignment["cycle_length"])
    return [_progress(path, n_states) for path in arrays_by_number("path", alignment)]


def _progress(path: StatePath, n_states: int) -> Array:
    """Return the number of cycles from the first state of the cycle to each frame (N,).

    A path runs from left to right, so that its steps are known from the states alone.
    """
    steps = np.concatenate([path[:1], np.diff(path) % n_states])
    return np.cumsum(steps) / n_states
