import time
from concurrent.futures import Future

import numpy as np
import pytest
from fill_workers import Here

from mocapbench.benchmark.filling.choosing import choice
from mocapbench.benchmark.filling.choosing.schedule import run_rounds
from mocapbench.benchmark.filling.fill_attempt import FillAttempt
from mocapbench.benchmark.filling.gap_problem import GapProblem, PredictedEntries


def test_nothing_starts_after_the_budget(waves, hidden):
    mask = hidden((50, 58, [0]))
    hold_out = choice.make_hold_outs(
        GapProblem(waves().hide(mask), mask), np.random.default_rng(0)
    )[0]
    workers = Here()
    (contender,) = run_rounds(["linear"], [hold_out], workers, 0.0, lambda *_: None)
    assert not workers.limits
    assert "budget" in contender.failure
    assert contender.timed_out


def test_models_that_are_slow_are_timed_out_and_no_others(waves, hidden):
    mask = hidden((50, 58, [0]))
    hold_out = choice.make_hold_outs(
        GapProblem(waves().hide(mask), mask), np.random.default_rng(0)
    )[0]
    contenders = run_rounds(
        ["linear", "hold"], [hold_out], Here(slow=("hold",)), 60.0, lambda *_: None
    )
    assert {contender.model: contender.timed_out for contender in contenders} == {
        "linear": False,
        "hold": True,
    }


def test_progress_counts_predictions(waves, hidden):
    mask = hidden((50, 58, [0]))
    hold_outs = choice.make_hold_outs(
        GapProblem(waves().hide(mask), mask), np.random.default_rng(0)
    )[:2]
    told = []
    run_rounds(
        ["linear", "hold"], hold_outs, Here(), 60.0, lambda done, total: told.append((done, total))
    )
    assert told[-1] == (4, 4)
    assert told == sorted(told)


class Slow(Here):
    """One worker, too slow for any prediction in the first round."""

    count = 1

    def submit(self, model, problem, seconds, method):
        self.slow = (model,) if seconds < 4.0 else ()
        return super().submit(model, problem, seconds, method)


def test_slow_models_have_their_hold_outs_one_after_another(waves, hidden):
    mask = hidden((50, 58, [0]))
    hold_outs = choice.make_hold_outs(
        GapProblem(waves().hide(mask), mask), np.random.default_rng(0)
    )[:3]
    workers = Slow()
    run_rounds(["linear", "hold"], hold_outs, workers, 64.0, lambda *_: None)
    models = [model for model, _ in workers.limits]
    assert models == ["linear", "hold", *["linear"] * 3, *["hold"] * 3]


class TwoSlow(Slow):
    """Two workers, of which the one that began first ends first."""

    count = 2


def test_from_its_first_prediction_on_all_workers_try_a_slow_model(waves, hidden):
    mask = hidden((50, 58, [0]))
    hold_outs = choice.make_hold_outs(
        GapProblem(waves().hide(mask), mask), np.random.default_rng(0)
    )[:4]
    workers = TwoSlow()
    linear, hold = run_rounds(["linear", "hold"], hold_outs, workers, 64.0, lambda *_: None)
    models = [model for model, _ in workers.limits][2:]
    assert models == ["linear", "hold", *["linear"] * 3, *["hold"] * 3]
    assert len(linear.predictions) == len(hold.predictions) == 4


class Scripted:
    """Two workers on a clock of their own, for which attempts take as long as a script says."""

    count = 2

    def __init__(self, seconds, failing=()):
        self.seconds, self.failing = seconds, failing
        self.now, self.tried, self.ends = 0.0, [], {}

    def keep(self, problem):
        self.tried.append([])
        return len(self.tried) - 1

    def submit(self, model, problem, seconds, method):
        self.tried[problem].append(model)
        took = self.seconds[model][problem]
        attempt = FillAttempt(PredictedEntries(np.zeros(1), None), seconds=took)
        if took > seconds:
            attempt = FillAttempt(None, "was stopped", seconds=seconds, timed_out=True)
        elif (model, problem) in self.failing:
            attempt = FillAttempt(None, "cannot do it", seconds=took)
        future = Future()
        future.set_result(attempt)
        self.ends[future] = self.now + min(took, seconds)
        return future

    def wait_for_any(self, futures):
        first = min(futures, key=self.ends.__getitem__)
        self.now = self.ends[first]
        return [first]

    def collect(self, future):
        return future.result()


@pytest.fixture
def scheduled(waves, hidden, monkeypatch):
    """Return a function from what models take in six hold-outs to contenders and workers."""
    mask = hidden((50, 58, [0]))
    hold_outs = choice.make_hold_outs(
        GapProblem(waves().hide(mask), mask), np.random.default_rng(0)
    )[:6]

    def run(seconds, failing=(), budget=32.0):
        workers = Scripted(seconds, failing)
        monkeypatch.setattr(time, "monotonic", lambda: workers.now)
        return run_rounds([*seconds], hold_outs, workers, budget, lambda *_: None), workers

    return run


def test_a_model_that_fails_in_a_hold_out_tries_no_other(scheduled):
    (contender,), workers = scheduled({"one": [2.0] * 6}, failing={("one", 1)})
    assert (len(contender.predictions), contender.failure, contender.timed_out) == (
        1,
        "cannot do it",
        False,
    )
    assert [len(models) for models in workers.tried] == [2, 1, 1, 0, 0, 0]


def test_an_prediction_that_comes_after_a_failure_in_a_later_hold_out_counts(scheduled):
    (contender,), _ = scheduled({"one": [2.0, 2.0, 3.0, 2.9, 2.0, 2.0]}, failing={("one", 3)})
    assert (len(contender.predictions), contender.failure) == (3, "cannot do it")


def test_models_that_were_stopped_later_keep_their_position_in_the_order(scheduled):
    """One predictions three hold-outs before it is stopped; the others are stopped at once."""
    slow = {name: [1.9] * 6 for name in ("two", "three", "four", "five", "six")}
    (one, *others), _ = scheduled({"one": [0.4] * 3 + [0.8] * 3, **slow}, budget=16.0)
    assert len(one.predictions) == 6
    assert len(others[-1].predictions) < 6


def test_no_hold_out_is_done_again_that_was_predictioned(scheduled):
    (contender,), workers = scheduled({"one": [2.0, 2.0, 2.0, 5.0, 2.0, 2.0]})
    assert len(contender.predictions) == 6
    assert [len(models) for models in workers.tried] == [2, 1, 1, 2, 1, 1]


@pytest.mark.parametrize("budget", [8.0, 16.0, 32.0])
def test_the_schedule_ends_with_its_budget(scheduled, budget):
    seconds = {name: [number / 2.0] * 6 for number, name in enumerate("abcdefgh", start=1)}
    _, workers = scheduled(seconds, budget=budget)
    assert workers.now <= budget
