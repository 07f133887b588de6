"""A record of a job that a metric fails names the metric."""

import math
from dataclasses import replace

import numpy as np
import pytest

from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.registry import METRICS
from mocapbench.benchmark.runs.evaluate import evaluate
from mocapbench.benchmark.runs.job import Work, WorkerConfig
from mocapbench.benchmark.runs.plan import plan
from mocapbench.benchmark.runs.record import Status
from mocapbench.benchmark.runs.request import Request
from mocapbench.metrics import Score

CONFIG = WorkerConfig((), (), 600.0, math.inf, 1, {})


def _raises(outcome):
    return {}["x"]


def _hoards(outcome):
    raise MemoryError


def _nothing(outcome):
    return None


def _in_place(outcome):
    errors = outcome.truth
    errors -= outcome.mean


def _overflowed_difference(outcome):
    huge = np.exp(np.full(2, 1e3))
    with np.errstate(invalid="ignore"):
        return Score(float((huge - huge).mean()))


FAULTS = {
    "a float": ({"statistic": lambda outcome: 0.5}, "to return a Score, got float"),
    "nothing": ({"statistic": _nothing}, "to return a Score, got NoneType"),
    "an array": (
        {"statistic": lambda outcome: Score(outcome.truth)},
        "to return a Score of one real number, got an array of float64 of shape",
    ),
    "an array of one number": (
        {"statistic": lambda outcome: Score(np.ones(1))},
        "one real number, got an array of float64 of shape (1,); write for example",
    ),
    "a text": ({"statistic": lambda outcome: Score("1.5")}, "one real number, got '1.5'; write"),
    "a complex number": ({"statistic": lambda outcome: Score(1 + 2j)}, "number, got (1+2j); wri"),
    "no value": ({"statistic": lambda outcome: Score(None)}, "one real number, got None; write"),
    "parts as a list": (
        {"statistic": lambda outcome: Score(1.0, {"frame": [1.0]})},
        "to give the parts of its Score as arrays, got [1.0] for 'frame'; write",
    ),
    "an error": ({"statistic": _raises}, "the metric 'mine' raised KeyError: 'x'"),
    "work in place": ({"statistic": _in_place}, "raised ValueError: output array is read-only"),
    "in defined": ({"defined": _raises}, "the metric 'mine' raised KeyError: 'x'"),
}


NOT_FINITE = {
    "infinite": (lambda outcome: Score(math.inf), "mine is inf; expected a finite score"),
    "minus infinite": (lambda outcome: Score(-math.inf), "mine is -inf; expected a finite score"),
    "overflowed": (
        lambda outcome: Score(float(np.square(np.full(2, 1e200)).mean())),
        "mine is inf: numbers overflowed; expected a finite score",
    ),
    "a difference of what overflowed": (
        _overflowed_difference,
        "mine is nan: numbers overflowed; expected a finite score",
    ),
}


@pytest.fixture
def record(monkeypatch):
    """Return a function from a metric's fields to the record of a job that it scores."""

    def record(**fields):
        fields = {"statistic": _nothing, **fields}
        metric = replace(METRICS.get("mse"), name="mine", title="Mine", **fields)
        monkeypatch.setattr(METRICS, "_added", {**METRICS._added, "mine": metric})
        task, archive = "toy-interpolation-1", archive_at()
        request = Request("smoke", (task,), ("trivial",), metrics=("mine",), folds=1)
        job = plan(request, archive)[0]
        return evaluate(Work(job, None), CONFIG, archive).record

    return record


@pytest.mark.parametrize(("fields", "message"), FAULTS.values(), ids=FAULTS)
def test_the_message_names_the_metric(record, fields, message):
    failed = record(**fields)
    assert failed.status is Status.FAILED
    assert "the metric 'mine'" in failed.message
    assert message in failed.message


def test_the_traceback_shows_where_the_metric_failed(record):
    assert 'return {}["x"]' in record(statistic=_raises).traceback


def test_a_metric_that_needs_too_much_memory_is_no_fault_of_the_metric(record):
    assert record(statistic=_hoards).status is Status.OUT_OF_MEMORY


@pytest.mark.parametrize(("statistic", "message"), NOT_FINITE.values(), ids=NOT_FINITE)
def test_a_score_that_is_not_finite_fails_the_job(record, statistic, message):
    failed = record(statistic=statistic)
    assert failed.status is Status.FAILED
    assert message in failed.message
    assert not failed.scores


@pytest.mark.parametrize(
    "value", [math.nan, 0.0, 1e300, -1e300, 3, True, np.float32(0.5), np.array(2.0), np.True_]
)
def test_a_finite_score_and_one_that_is_not_defined_are_kept(record, value):
    ended = record(statistic=lambda outcome: Score(value))
    assert ended.status is Status.OK
    assert ended.scores == pytest.approx({"mine": float(value)}, rel=0, nan_ok=True)


@pytest.fixture
def job_record(monkeypatch):
    """Return a function from metrics by name to the record of a job that they and `mse` score."""

    def job_record(**statistics):
        added = {
            name: replace(METRICS.get("mse"), name=name, title=name, statistic=statistic)
            for name, statistic in statistics.items()
        }
        monkeypatch.setattr(METRICS, "_added", {**METRICS._added, **added})
        task, archive = "toy-interpolation-1", archive_at()
        request = Request("smoke", (task,), ("trivial",), metrics=("mse", *added), folds=1)
        return evaluate(Work(plan(request, archive)[0], None), CONFIG, archive).record

    return job_record


def test_a_metric_that_fails_costs_no_other_its_score(job_record):
    failed, whole = job_record(bad=_raises, worse=_nothing), job_record()
    assert failed.status is Status.FAILED
    assert dict(failed.scores) == dict(whole.scores) != {}
    assert failed.parts == whole.parts
    assert failed.problem == whole.problem
    assert "the metric 'bad' raised KeyError: 'x'" in failed.message
    assert "expected the metric 'worse' to return a Score" in failed.message
    assert failed.message.endswith("(1 other score kept)")
    assert failed.traceback.count("Traceback") >= 2


def test_a_job_of_which_every_metric_fails_has_no_score(job_record, monkeypatch):
    monkeypatch.setattr(METRICS.get("mse").__class__, "__call__", lambda *_: _raises(None))
    failed = job_record()
    assert failed.status is Status.FAILED
    assert (failed.scores, failed.parts) == ({}, {})
    assert "kept" not in failed.message
