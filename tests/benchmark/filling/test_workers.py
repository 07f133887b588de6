import numpy as np
import pytest

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
            return [workers.collect(future) for future in futures]

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


def test_a_model_that_hangs_is_stopped(attempts):
    hangs, linear = attempts("hangs", "linear", seconds=1.5)
    assert hangs.timed_out
    assert hangs.prediction is None
    assert "1.5 s" in hangs.failure
    assert linear.prediction is not None


def test_a_model_that_takes_all_memory_is_stopped(attempts):
    (hungry,) = attempts("hungry")
    assert "GiB of memory" in hungry.failure


def test_a_model_fills_with_calibrated_variances_unless_it_is_named_otherwise(attempts):
    calibrated, plain = attempts("lds", "lds-uncalibrated")
    np.testing.assert_array_equal(calibrated.prediction.mean, plain.prediction.mean)
    assert (calibrated.prediction.variance != plain.prediction.variance).any()
