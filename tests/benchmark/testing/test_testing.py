"""The conformance kit names the fault of whatever does not conform."""

import re
import runpy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mocapbench.baselines import Model
from mocapbench.baselines.mohgp import MOHGP
from mocapbench.baselines.trivial import Trivial
from mocapbench.benchmark.tasks.base import Case, Entrant, Selection
from mocapbench.benchmark.tasks.toy_interpolation_1 import ToyInterpolation1
from mocapbench.benchmark.testing import (
    ConformanceError,
    check_metric,
    check_model,
    check_task,
    model_checks,
)
from mocapbench.datasets import open_archive
from mocapbench.metrics import Direction, Imputation, Metric, Score

NONCONFORMING = runpy.run_path(str(Path(__file__).parents[1] / "broken_models.py"))["NONCONFORMING"]


@pytest.mark.parametrize("model", NONCONFORMING, ids=lambda model: model.__name__)
def test_a_model_that_does_not_conform_is_told_why(model):
    """Each of its checks is asked: another may be the first that fails."""
    messages = []
    for check in model_checks(model):
        try:
            check(model)
        except ConformanceError as error:
            messages.append(str(error))
    assert messages
    assert all(message.startswith(f"{model.__name__}: expected") for message in messages)
    assert any(re.search(NONCONFORMING[model], message) for message in messages)


def test_parameters_reach_the_model():
    with pytest.raises(ConformanceError, match="n_components"):
        check_model(MOHGP, n_components=-1)


def test_parameters_that_the_model_has_not_are_no_silence():
    with pytest.raises(ConformanceError, match="max_itr"):
        check_model(Trivial, max_itr=20)


class _Unable(Model):
    """Inherits no ability."""

    def fit(self, recordings):
        return self


@pytest.mark.parametrize("model", [Trivial(), "trivial", int, _Unable])
def test_what_is_no_model_is_told_so(model):
    with pytest.raises(ConformanceError, match=r"expected a .*: pass the class itself"):
        check_model(model)


@pytest.mark.parametrize("task", [ToyInterpolation1, "toy-interpolation-1"])
def test_what_is_no_task_is_told_so(task):
    with pytest.raises(
        ConformanceError, match=r"expected a mocapbench\.benchmark\.tasks\.base\.Task"
    ):
        check_task(task)


def _value(outcome):
    """Return one."""
    return Score(1.0)


def test_what_is_no_metric_is_told_so():
    with pytest.raises(ConformanceError, match=r"expected a mocapbench\.metrics\.Metric"):
        check_metric(_value)


def _undocumented(outcome):
    return Score(1.0)


def _nan(outcome):
    """Return NaN."""
    return Score(np.nan)


def _number(outcome):
    """Return no Score."""
    return 1.0


def _random(outcome):
    """Return something else every time."""
    return Score(float(np.random.default_rng().random()))


def _everything(outcome):
    """Return the error over all entries."""
    return Score(float(((outcome.truth - outcome.mean) ** 2).mean()))


def _raises(outcome):
    """Raise."""
    raise ZeroDivisionError("no frames")


GOOD = Metric("m", "M", Direction.LOWER, Imputation, _value)


def test_a_metric_that_conforms_passes():
    check_metric(GOOD)


@pytest.mark.parametrize(
    ("changes", "complaint"),
    [
        ({"statistic": _undocumented}, "a docstring of the statistic"),
        ({"statistic": _nan}, "a finite value of a plain outcome, got nan"),
        ({"statistic": _number}, "expected a Score, got float"),
        ({"statistic": _random}, "draw nothing in a metric"),
        ({"statistic": _everything}, "whatever the visible entries are"),
        ({"statistic": _raises}, "got ZeroDivisionError: no frames"),
        ({"direction": Direction.TARGET}, "expected a target, got None"),
        ({"target": 1.0}, "expected no target where lower is better, got 1.0"),
        ({"outcome": int}, "expected an outcome among"),
    ],
)
def test_a_metric_that_does_not_conform_is_told_why(changes, complaint):
    with pytest.raises(ConformanceError, match=rf"^metric m: .*{complaint}"):
        check_metric(replace(GOOD, **changes))


class Leaky(ToyInterpolation1):
    """A task with room for faults."""

    def problem(self, case, seeds, archive):
        return super().problem(case, seeds, archive)


class Unseeded(Leaky):
    def problem(self, case, seeds, archive):
        fold = int(np.random.default_rng().integers(10**6))
        return super().problem(case, replace(seeds, fold=fold), archive)


class SameFold(Leaky):
    def problem(self, case, seeds, archive):
        return super().problem(case, replace(seeds, fold=0), archive)


class NothingHidden(Leaky):
    def problem(self, case, seeds, archive):
        posed = super().problem(case, seeds, archive)
        shown = posed.given[0].with_values(posed.truth[0])
        return replace(posed, given=(shown,))


class OtherTruth(Leaky):
    def problem(self, case, seeds, archive):
        posed = super().problem(case, seeds, archive)
        return replace(posed, truth=(posed.truth[0] + 1.0,))


class Unposable(Leaky):
    def problem(self, case, seeds, archive):
        raise RuntimeError("no process")


@pytest.mark.parametrize(
    ("task", "complaint"),
    [
        (Unseeded, "again at the same address"),
        (SameFold, "another problem in another fold, got the same"),
        (NothingHidden, "expected hidden entries in child-5, got none"),
        (OtherTruth, "the truth where it is visible"),
        (Unposable, "it poses a problem, got RuntimeError: no process"),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_a_task_whose_problems_are_wrong_is_told_why(task, complaint):
    with pytest.raises(ConformanceError, match=complaint):
        check_task(task())


@pytest.mark.parametrize(
    ("field", "value", "complaint"),
    [
        ("cases", (Case("a", {}), Case("a", {})), r"cases with different names, got \['a'\]"),
        ("entrants", (Entrant("x", "knn"), Entrant("x", "moa")), "labels of entrants"),
        ("version", 0, "expected a version from 1, got 0"),
        ("metrics", (), "expected metrics to show, got none"),
        ("metrics", ("msee",), r"metrics among .* got \['msee'\]"),
        ("requires", (int,), "expected abilities from mocapbench.baselines"),
        ("published_models", {"me": "ME"}, r"published_models among .* got \['me'\]"),
        ("published_metrics", {"pit": "PIT"}, r"published_metrics among .* got \['pit'\]"),
        ("profiles", {}, "at least one profile, got none"),
        ("profiles", {"smoke": Selection(("test 0",), 1)}, "cases of profile smoke"),
        ("profiles", {"smoke": Selection(("test 1",), 0)}, "folds in profile smoke, got 0"),
        ("max_folds", 1, "expected 1 to 1 folds in profile smoke, got 2"),
    ],
)
def test_a_task_that_is_not_consistent_is_told_why(field, value, complaint):
    task = Leaky()
    setattr(task, field, value)
    with pytest.raises(ConformanceError, match=complaint):
        check_task(task)


def test_a_task_that_cannot_be_tried_without_recordings_is_told_so(tmp_path, monkeypatch):
    monkeypatch.setenv("MOCAPBENCH_CACHE", str(tmp_path))
    task = Leaky()
    task.cases = (Case("test 1", {}, ("cmu:02_01",)),)
    task.profiles = {"smoke": Selection(("test 1",), 1)}
    with pytest.raises(ConformanceError, match="add one on generated data"):
        check_task(task, open_archive(tmp_path))
