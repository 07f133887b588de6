import numpy as np
import pytest

from mocapbench.benchmark.filling import workers
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.filling.workers import Workers
from mocapbench.benchmark.plugins import load_plugin


@pytest.fixture
def attempts(broken_models, waves, hidden):
    """Return a function from the names of models to how their attempts ended."""
    load_plugin(broken_models)
    mask = hidden((50, 60, [0]))

    def ask(*models, seconds=20.0):
        with Workers(2, (broken_models,)) as workers:
            problem = workers.keep(GapProblem(waves().hide(mask), mask))
            futures = [workers.submit(model, problem, seconds) for model in models]
            ended = workers.collect(futures)
            return [ended[future] for future in futures]

    return ask


def test_models_that_break_say_why_and_the_others_go_on(attempts):
    raises, nan, exits, crashes, linear = attempts(
        "raises", "not-a-number", "exits", "dies", "linear"
    )
    assert "RuntimeError: the model <b>raised</b>" in raises.failure
    assert "expected a finite mean" in nan.failure
    assert "SystemExit" in exits.failure
    assert "process died" in crashes.failure
    assert linear.prediction.mean.shape == (10,)


@pytest.mark.slow
def test_a_model_that_hangs_is_stopped_and_one_that_breaks_is_not(attempts, monkeypatch):
    monkeypatch.setattr(workers, "_LEAST_LIMIT", 1.5)
    monkeypatch.setattr(workers, "_WAITING", 1.0)
    hangs, linear, raises = attempts("hangs", "linear", "raises", seconds=0.01)
    assert hangs.stopped
    assert hangs.prediction is None
    assert "1.5 s" in hangs.failure
    assert linear.prediction is not None
    assert not linear.stopped
    assert not raises.stopped


def test_a_model_that_works_too_long_is_stopped_by_the_work_that_it_did(attempts, monkeypatch):
    """Not by how long that took, which other work on the machine decides."""
    monkeypatch.setattr(workers, "_LEAST_LIMIT", 0.5)
    monkeypatch.setattr(workers, "_WAITING", 1000.0)
    (spins,) = attempts("spins", seconds=0.01)
    assert spins.stopped
    assert "of work" in spins.failure


@pytest.mark.parametrize(("seconds", "limit"), [(0.001, 120.0), (5.9, 120.0), (100.0, 2000.0)])
def test_the_limit_is_far_above_what_is_predicted(monkeypatch, seconds, limit):
    """A busy machine takes longer, and no choice may depend on that."""
    limits = []
    with Workers(1) as some:
        monkeypatch.setattr(some._pool, "submit", lambda *arguments: limits.append(arguments[-2:]))
        some.submit("linear", None, seconds)
    assert limits == [(limit, 5 * limit)]


def test_a_model_that_takes_all_memory_is_stopped(attempts):
    (hungry,) = attempts("hungry")
    assert "GiB of memory" in hungry.failure
    assert hungry.stopped


def test_a_model_fills_with_calibrated_variances_unless_it_is_named_otherwise(attempts):
    calibrated, plain = attempts("lds", "lds-uncalibrated")
    np.testing.assert_array_equal(calibrated.prediction.mean, plain.prediction.mean)
    assert (calibrated.prediction.variance != plain.prediction.variance).any()


def test_progress_counts_attempts_that_ended(broken_models, waves, hidden):
    mask, told = hidden((50, 60, [0])), []
    with Workers(2, (broken_models,)) as some:
        problem = some.keep(GapProblem(waves().hide(mask), mask))
        futures = [some.submit(model, problem, 20.0) for model in ("linear", "raises", "hold")]
        some.collect(futures, lambda *counts: told.append(counts))
    assert told[-1] == (3, 3)
    assert told == sorted(told)
