"""A model that is fitted once answers every problem as one that is fitted anew for it."""

import dataclasses
import math

import numpy as np
import pytest

from mocapbench.baselines import FrameImputer, Inductive, Prediction
from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.registry import MODELS, TASKS
from mocapbench.benchmark.runs.evaluate import evaluate
from mocapbench.benchmark.runs.job import Work, WorkerConfig
from mocapbench.benchmark.runs.plan import plan
from mocapbench.benchmark.runs.request import Request, entrants

CONFIG = WorkerConfig((), (), 600.0, math.inf, 1, {})
TASK = "missing-frames"
COSTS = {"fit_seconds", "predict_seconds", "peak_memory_mb", "arrays"}


class Drawn(FrameImputer, Inductive):
    """Fills with a number drawn in fit; cannot be pickled if told so."""

    def __init__(self, pickles=True, random_state=None):
        self.pickles = pickles
        self.random_state = random_state

    def fit(self, recordings):
        self.level_ = np.random.default_rng(self.random_state).random()
        self.more_ = None if self.pickles else lambda: None
        return self

    def impute(self, recordings):
        self.level_ += 1.0  # of no consequence for others
        return [Prediction.around(recording, self.level_) for recording in recordings]


def _brief(job):
    """Return a job that samples for seconds rather than minutes."""
    budget = {"n_steps": 1, "n_samples": 2, "fill_iter": 1, "n_restarts": 1, "n_states": 16}
    own = {name: value for name, value in budget.items() if name in job.parameters}
    return dataclasses.replace(job, parameters={**job.parameters, **own})


@pytest.fixture
def jobs():
    """Return a function from an entrant to its jobs on two folds of two cases."""

    def jobs(label, *cases):
        cases = cases or ("synthetic 1", "synthetic 2")
        request = Request("smoke", (TASK,), (label,), cases, folds=2)
        found = plan(request, archive_at())  # other entrants of the model called so, too
        return [_brief(job) for job in found if job.address.label == label]

    return jobs


@pytest.fixture
def drawn(monkeypatch):
    monkeypatch.setattr(MODELS, "_added", {**MODELS._added, "drawn": Drawn}, raising=False)
    return "drawn"


def _evaluated(job, trained=None):
    ended = evaluate(Work(job, None, trained=trained), CONFIG, archive_at())
    assert ended.record.message == ""
    return ended


def _same(one, other):
    assert one.record.scores == other.record.scores
    assert one.fit.arrays.keys() == other.fit.arrays.keys()
    for name, array in one.fit.arrays.items():
        np.testing.assert_array_equal(array, other.fit.arrays[name])
    costs = ({k: v for k, v in vars(each.fit).items() if k not in COSTS} for each in (one, other))
    assert next(costs) == next(costs)


@pytest.mark.slow
@pytest.mark.parametrize("label", [entrant.label for entrant in entrants(TASKS.get(TASK))])
def test_every_entrant_answers_alike_fitted_once_and_fitted_anew(label, jobs):
    first, *_, last = jobs(label)
    assert first.training_key == last.training_key
    trained = _evaluated(first).trained
    shared = _evaluated(last, trained)
    assert shared.trained is None
    assert shared.fit.fit_seconds == trained.costs.seconds
    _same(shared, _evaluated(last))


def test_what_is_learnt_does_not_depend_on_the_fold_or_the_case(jobs, drawn):
    levels = {_evaluated(job).fit.arrays["mean-0"][20, 0] for job in jobs(drawn)}
    assert len(levels) == 1


def test_a_model_that_cannot_be_pickled_is_fitted_anew_to_the_same_end(jobs, drawn):
    job, *_ = jobs(drawn)
    unshared = dataclasses.replace(job, parameters={"pickles": False})
    ended = _evaluated(unshared)
    assert ended.trained is None
    _same(ended, _evaluated(job))


def test_a_model_of_other_recordings_is_not_used(jobs, drawn):
    """Which a task's author may have said to be the same."""
    job, *_ = jobs(drawn)
    trained = _evaluated(job).trained
    other = dataclasses.replace(trained, learnt_from="something else")
    ended = _evaluated(job, other)
    assert ended.trained == dataclasses.replace(trained, costs=ended.trained.costs)


def test_it_remains_where_a_problem_then_fails(jobs, drawn, monkeypatch):
    job, *_ = jobs(drawn)
    monkeypatch.setattr(Drawn, "impute", lambda *_: 1 / 0)
    ended = evaluate(Work(job, None), CONFIG, archive_at())
    assert "ZeroDivisionError" in ended.record.message
    assert "1 / 0" in ended.record.traceback
    assert ended.trained is not None


@pytest.mark.parametrize(
    "change",
    [{"seed": 1}, {"models": ("gplvm-window",)}, {"profile": "paper"}],
    ids=lambda change: next(iter(change)),
)
def test_the_key_of_a_fitted_model_covers_what_it_follows_from(change):
    asked = {"models": ("gplvm-linear",), "cases": ("synthetic 1",), "tasks": (TASK,), "seed": 0}
    one, other = (
        plan(Request(**{"profile": "smoke", **asked, **changes}), archive_at())[0]
        for changes in ({}, change)
    )
    assert one.training_key != other.training_key


def test_a_training_key_is_shared_by_no_other_training(jobs):
    (walker,) = {job.training_key for job in jobs("knn")}
    request = Request("smoke", ("golf-swings",), ("knn",), ("synthetic",), folds=2)
    (swing,) = {job.training_key for job in plan(request, archive_at())}
    assert walker != swing
