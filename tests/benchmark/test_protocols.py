"""Goldens of what models are asked: they move only when a task's version does."""

import os
from pathlib import Path

import numpy as np
import pytest

from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.seeds import Seeds
from mocapbench.benchmark.solving import build_model
from mocapbench.datasets import open_archive

GOLDENS = Path(__file__).parents[1] / "goldens"
needs_recordings = [
    pytest.mark.recordings,
    pytest.mark.skipif(
        "MOCAPBENCH_DATA" not in os.environ, reason="MOCAPBENCH_DATA names no recordings"
    ),
]
PROBLEMS = [
    ("toy-interpolation-1", "test 1"),
    ("toy-interpolation-1", "test 5"),
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
    hidden = ~problem.given[0].visible
    frames, channels = hidden.shape
    spline = build_model("cubic-spline", {}, 0).fit(problem.train)
    outcome = problem.outcome(problem.solve(spline, 0))
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
    golden = GOLDENS / f"{task}-{case.replace(' ', '-')}.csv"
    num_regression.check(found, default_tolerance={"rtol": 1e-7, "atol": 0}, fullpath=golden)


@pytest.mark.parametrize("number", range(1, 10))
def test_five_of_fifty_points_of_each_output_are_visible(number):
    problem = _problem("toy-interpolation-1", f"test {number}")
    settings = TASKS.get("toy-interpolation-1").case(f"test {number}").settings
    (given,) = problem.given
    assert given.values.shape == (50, settings["outputs"])
    assert (given.visible.sum(axis=0) == 5).all()
    assert len(problem.train) == settings["children"]
    assert all(child.visible.all() for child in problem.train[:-1])
    assert problem.process.noise == settings["noise"]


@pytest.mark.parametrize("case", TASKS.get("walking-interpolation").cases, ids=lambda c: c.name)
def test_as_many_frames_of_each_channel_are_visible_as_the_case_says(case):
    if not all(map(open_archive().available, case.sources)):
        pytest.skip("MOCAPBENCH_DATA names no recordings")
    (given,) = _problem("walking-interpolation", case.name).given
    assert given.values.shape == (90, 39)
    assert (given.visible.sum(axis=0) == case.settings["visible frames"]).all()
