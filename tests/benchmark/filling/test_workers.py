import pytest

from mocapbench.benchmark.filling.question import GapQuestion
from mocapbench.benchmark.filling.workers import Workers
from mocapbench.benchmark.plugins import load_plugin


@pytest.fixture
def answers(broken_models, waves, hidden):
    """Return a function from the names of models to how their attempts ended."""
    load_plugin(broken_models)
    mask = hidden((50, 60, [0]))

    def ask(*models, seconds=20.0):
        with Workers(2, (broken_models,)) as workers:
            question = workers.keep(GapQuestion(waves().hide(mask), mask))
            futures = [workers.submit(model, question, seconds) for model in models]
            return [workers.result(future) for future in futures]

    return ask


def test_models_that_break_say_why_and_the_others_go_on(answers):
    raises, nan, exits, crashes, linear = answers(
        "raises", "not-a-number", "exits", "dies", "linear"
    )
    assert "RuntimeError: the model <b>raised</b>" in raises.trouble
    assert "expected a finite mean" in nan.trouble
    assert "SystemExit" in exits.trouble
    assert "process died" in crashes.trouble
    assert linear.answer.mean.shape == (10,)


def test_a_model_that_hangs_is_stopped(answers):
    hangs, linear = answers("hangs", "linear", seconds=1.5)
    assert hangs.slow
    assert hangs.answer is None
    assert "1.5 s" in hangs.trouble
    assert linear.answer is not None


def test_a_model_that_takes_all_memory_is_stopped(answers):
    (hungry,) = answers("hungry")
    assert "GiB of memory" in hungry.trouble
