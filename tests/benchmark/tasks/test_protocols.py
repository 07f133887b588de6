"""Goldens of what models are asked: they move only when a task's version does."""

import os
from pathlib import Path

import numpy as np
import pytest

from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.runs.solve import build_model
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import open_archive

GOLDENS = Path(__file__).parents[2] / "goldens"
needs_recordings = [
    pytest.mark.recordings,
    pytest.mark.skipif(
        "MOCAPBENCH_DATA" not in os.environ, reason="MOCAPBENCH_DATA names no recordings"
    ),
]
PROBLEMS = [
    ("toy-interpolation-1", "test 1"),
    ("toy-interpolation-1", "test 5"),
    ("toy-interpolation-2", "test 1"),
    ("toy-interpolation-3", "test 2"),
    ("walking-interpolation", "synthetic observed 40"),
    ("missing-frames", "synthetic 1"),
    ("upper-body-missing", "synthetic walks"),
    pytest.param("upper-body-missing", "subject 07 walks", marks=needs_recordings),
    pytest.param("walking-interpolation", "observed 40", marks=needs_recordings),
    pytest.param("walking-interpolation", "observed 10", marks=needs_recordings),
    pytest.param("missing-frames", "35-03 three-walkers", marks=needs_recordings),
]


def _problem(task, case, fold=1):
    task = TASKS.get(task)
    seeds = Seeds(0, task.name, task.version, case, fold)
    return task.problem(task.case(case), seeds, open_archive())


@pytest.mark.parametrize(("task", "case"), PROBLEMS)
def test_a_problem_is_what_it_was(task, case, num_regression):
    problem = _problem(task, case)
    frames, channels = problem.given[0].values.shape
    spline = build_model("cubic-spline", {}, 0).fit(problem.train)
    outcome = problem.outcome(problem.solve(spline, 0))
    hidden = outcome.hidden
    found = {
        "recordings": len(problem.train),
        "frames": frames,
        "channels": channels,
        "hidden": int(hidden.sum()),
        "hidden centre of frames": float(np.argwhere(hidden)[:, 0].mean()),
        "hidden centre of channels": float(np.argwhere(hidden)[:, 1].mean()),
        "span": float(np.ptp(problem.given[0].times)),
        "truth": float(np.abs(outcome.truth[hidden]).mean()),
        "train": float(np.nanmean([np.nanmean(np.abs(r.values)) for r in problem.train])),
        "visible variance": float(outcome.visible_variance.mean()),
        "spline error": METRICS.get("mse")(outcome).value,
    }
    _check_golden(num_regression, found, f"{task}-{case.replace(' ', '-')}")


def test_a_synthesis_problem_is_what_it_was(num_regression):
    problem = _problem("toy-synthesis", "test 5")
    found = {
        "train": _size([r.values for r in problem.train]),
        "references": _size(problem.references),
        "parent": _size(problem.parent.values),
        "control": _size(problem.control.covariance(problem.times)),
    }
    _check_golden(num_regression, found, "toy-synthesis-test-5")


def test_a_recovery_problem_is_what_it_was(num_regression):
    problem = _problem("covariance-recovery", "correlated outputs")
    found = {layer: _size(covariance) for layer, covariance in problem.truth.items()}
    found["train"] = _size([r.values for r in problem.train])
    _check_golden(num_regression, found, "covariance-recovery")


def _size(values):
    return float(np.abs(values).mean())


def _check_golden(num_regression, found, name):
    golden = GOLDENS / f"{name}.csv"
    num_regression.check(found, default_tolerance={"rtol": 1e-7, "atol": 0}, fullpath=golden)


TOY = [
    (name, case.name, {"outputs": 3, "children": 10, "noise": 0.1, "visible": 5, **case.settings})
    for name in ("toy-interpolation-1", "toy-interpolation-2", "toy-interpolation-3")
    for case in TASKS.get(name).cases
]


@pytest.mark.parametrize(("task", "case", "row"), TOY)
def test_toy_data_are_as_the_row_says(task, case, row):
    problem = _problem(task, case)
    assert len(problem.train) == row["children"]
    assert len(problem.given) == (row["children"] if row.get("missing in") == "all" else 1)
    assert problem.train[-len(problem.given) :] == problem.given
    for given, truth in zip(problem.given, problem.truth, strict=True):
        assert given.values.shape == truth.shape == (50, row["outputs"])
        assert (given.visible.sum(axis=0) == row["visible"]).all()
    assert all(child.visible.all() for child in problem.train[: -len(problem.given)])
    assert problem.process.noise == row["noise"]
    n_components = 1 if task == "toy-interpolation-3" else 3
    assert len(problem.process.parent.lengthscales) == n_components


def test_the_true_parent_is_what_the_children_vary_around():
    problem = _problem("toy-interpolation-3", "test 4")
    complete = np.mean([child.values for child in problem.train[:-1]], axis=0)
    # Nine children with a variance of .25 and noise of .1 are off by .2 on average.
    assert np.sqrt(np.mean((complete - problem.parent.values) ** 2)) < 2 * 0.2


@pytest.mark.parametrize("case", TASKS.get("walking-interpolation").cases, ids=lambda c: c.name)
def test_as_many_frames_of_each_channel_are_visible_as_the_case_says(case):
    if not all(map(open_archive().available, case.sources)):
        pytest.skip("MOCAPBENCH_DATA names no recordings")
    (given,) = _problem("walking-interpolation", case.name).given
    assert given.values.shape == (90, 39)
    assert (given.visible.sum(axis=0) == case.settings["visible frames"]).all()
