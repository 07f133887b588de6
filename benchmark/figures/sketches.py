"""What there is to see in the solutions of a problem: one function per kind of problem."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import singledispatch

import numpy as np
from numpy.typing import NDArray
from sklearn.decomposition import PCA

from mocapbench.baselines import StatePath
from mocapbench.benchmark.figures.blend import blend_sketch
from mocapbench.benchmark.figures.covariances import recovery_sketch
from mocapbench.benchmark.problems.base import Problem, Solution
from mocapbench.benchmark.problems.cluster import ClusterProblem
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.problems.recover import RecoverProblem
from mocapbench.benchmark.tasks.base import Task
from mocapbench.reports import Curve, Illustration, Panel, Picture

__all__ = ["sketch"]

Array = NDArray[np.float64]
Solutions = Mapping[str, Solution]


@singledispatch
def sketch(problem: Problem, task: Task, solutions: Solutions) -> Sequence[Picture]:
    """Return figures of the ``solutions``, by label, of one problem of ``task``."""
    del problem, task, solutions  # of this kind, scores tell all
    return ()


@sketch.register
def _filled_channels(
    problem: ImputeProblem, task: Task, solutions: Solutions
) -> Sequence[Illustration]:
    """Show filled channels beside the truth, of the first recording: HLM Figure 4."""
    recording, truth = problem.given[0], problem.truth[0]
    filled = {
        label: np.where(recording.visible, np.nan, solutions[label]["mean-0"])
        for label in _of_interest(problem, task, solutions)
    }
    columns = [recording.channels.index(channel) for channel in task.illustrated_channels]
    panels = tuple(
        Panel(
            recording.channels[column],
            "time, s",
            recording.units[column],
            tuple(
                Curve(recording.times, values[:, column], label)
                for label, values in {"truth": truth, **filled}.items()
            ),
        )
        for column in columns
    )
    caption = (
        f"{recording.name}, the truth and what was put where it is hidden by the paper’s models "
        "and by the best of the others in this run."
    )
    return (Illustration(task.name, "Filled channels", caption, panels),)


@sketch.register
def _covariances(problem: RecoverProblem, task: Task, solutions: Solutions) -> Sequence[Picture]:
    """Show the true and the estimated covariances: thesis Figures 11–13."""
    return recovery_sketch(problem, task, solutions)


def _of_interest(problem: ImputeProblem, task: Task, solutions: Solutions) -> list[str]:
    """Return the labels that the paper has too, and the best of the others."""
    hidden = ~problem.given[0].visible
    errors = {
        label: float(((solution["mean-0"] - problem.truth[0])[hidden] ** 2).mean())
        for label, solution in solutions.items()
    }
    papers = [label for label in errors if label in task.published_models]
    others = sorted(set(errors) - set(papers), key=errors.__getitem__)
    return [*papers, *others[:1]]


@sketch.register
def _alignments(
    problem: ClusterProblem, task: Task, solutions: Solutions
) -> Sequence[Illustration]:
    """Show the recordings as they are and on the cycle of each model that aligns: HLM Figure 1."""
    component = _second_component([recording.values for recording in problem.train])
    recorded = [recording.times - recording.times[0] for recording in problem.train]
    panels = [_by_style("as recorded", "time, s", recorded, component, problem.truth)]
    for label, solution in solutions.items():
        if "cycle_length" in solution:
            paths = [solution[f"path-{k}"] for k in range(len(problem.train))]
            cycles = [_cycles(path, int(solution["cycle_length"])) for path in paths]
            panels.append(
                _by_style(f"aligned by {label}", "cycles", cycles, component, problem.truth)
            )
    caption = (
        "second principal component of every recording, first over time and then over the states "
        "of the common cycle that each model aligned its frames with. Styles are those of the "
        "labels, which no model saw."
    )
    before_and_after = Illustration(task.name, "Before and after alignment", caption, tuple(panels))
    blends = [
        blend_sketch(problem, task, label, solution)
        for label, solution in solutions.items()
        if "blend" in solution
    ]
    return (before_and_after, *blends)


def _by_style(
    title: str, x_label: str, x: Sequence[Array], y: Sequence[Array], styles: Sequence[str]
) -> Panel:
    curves = tuple(map(Curve, x, y, styles))
    return Panel(title, x_label, "2nd component", curves)


def _second_component(recordings: Sequence[Array]) -> list[Array]:
    """Return the second principal component (N_k,) of each of ``recordings`` (N_k, D)."""
    analysis = PCA(n_components=2, svd_solver="full").fit(np.concatenate(recordings))
    return [analysis.transform(values)[:, 1] for values in recordings]


def _cycles(path: StatePath, n_states: int) -> Array:
    """Return how many cycles each frame is into its recording, from where the first one starts.

    A path runs from left to right, so that its steps are known from the states alone.
    """
    advance = np.concatenate([path[:1], np.diff(path) % n_states])
    return np.cumsum(advance) / n_states
