"""Goldens of the problems of our tasks: they change only when a task's version does."""

import os
from pathlib import Path

import numpy as np
import pytest

from mocapbench.baselines import CubicSplineImputer
from mocapbench.benchmark import METRICS

GOLDENS = Path(__file__).parents[2] / "goldens"
FOLD = 1
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
    ("subject-35-missing", "synthetic right leg"),
    pytest.param("upper-body-missing", "subject 07 walks", marks=needs_recordings),
    pytest.param("walking-interpolation", "observed 40", marks=needs_recordings),
    pytest.param("walking-interpolation", "observed 10", marks=needs_recordings),
    pytest.param("missing-frames", "35-03 three-walkers", marks=needs_recordings),
]


@pytest.mark.parametrize(("task", "case"), PROBLEMS)
def test_a_problem_is_what_it_was(posed, task, case, num_regression):
    problem = posed(task, case, FOLD)
    frames, channels = problem.given[0].values.shape
    spline = CubicSplineImputer().fit(problem.train)
    outcome = problem.outcome(problem.solve(spline, 0))
    hidden = outcome.hidden
    sizes = {
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
    _check_golden(num_regression, sizes, f"{task}-{case.replace(' ', '-')}")


def test_a_synthesis_problem_is_what_it_was(posed, num_regression):
    problem = posed("toy-synthesis", "test 5", FOLD)
    sizes = {
        "train": _size([r.values for r in problem.train]),
        "references": _size(problem.references),
        "parent": _size(problem.parent.values),
        "control": _size(problem.control.covariance(problem.times)),
    }
    _check_golden(num_regression, sizes, "toy-synthesis-test-5")


def test_a_recovery_problem_is_what_it_was(posed, num_regression):
    problem = posed("covariance-recovery", "correlated outputs", FOLD)
    sizes = {layer: _size(covariance) for layer, covariance in problem.truth.items()}
    sizes["train"] = _size([r.values for r in problem.train])
    _check_golden(num_regression, sizes, "covariance-recovery")


def _size(values):
    return float(np.abs(values).mean())


def _check_golden(num_regression, sizes, name):
    golden = GOLDENS / f"{name}.csv"
    num_regression.check(sizes, default_tolerance={"rtol": 1e-7, "atol": 0}, fullpath=golden)
