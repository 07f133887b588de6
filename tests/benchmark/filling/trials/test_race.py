import time
from concurrent.futures import Future

import numpy as np
import pytest
from fill_workers import Here

from mocapbench.benchmark.filling.attempt import Attempt
from mocapbench.benchmark.filling.question import FilledEntries, GapQuestion
from mocapbench.benchmark.filling.trials import choice
from mocapbench.benchmark.filling.trials.race import race


def test_nothing_starts_after_the_budget(waves, hidden):
    mask = hidden((50, 58, [0]))
    trial = choice.make_trials(GapQuestion(waves().hide(mask), mask), np.random.default_rng(0))[0]
    workers = Here()
    (runner,) = race(["linear"], [trial], workers, 0.0, lambda *_: None)
    assert not workers.limits
    assert "budget" in runner.trouble
    assert runner.late


def test_models_that_are_slow_are_late_and_no_others(waves, hidden):
    mask = hidden((50, 58, [0]))
    trial = choice.make_trials(GapQuestion(waves().hide(mask), mask), np.random.default_rng(0))[0]
    runners = race(["linear", "hold"], [trial], Here(slow=("hold",)), 60.0, lambda *_: None)
    assert {runner.model: runner.late for runner in runners} == {"linear": False, "hold": True}


def test_progress_counts_answers(waves, hidden):
    mask = hidden((50, 58, [0]))
    trials = choice.make_trials(GapQuestion(waves().hide(mask), mask), np.random.default_rng(0))[:2]
    told = []
    race(["linear", "hold"], trials, Here(), 60.0, lambda done, total: told.append((done, total)))
    assert told[-1] == (4, 4)
    assert told == sorted(told)


class Slow(Here):
    """One worker, too slow for any answer in the first round."""

    count = 1

    def submit(self, model, question, seconds, method):
        self.slow = (model,) if seconds < 4.0 else ()
        return super().submit(model, question, seconds, method)


def test_slow_models_have_their_trials_one_after_another(waves, hidden):
    mask = hidden((50, 58, [0]))
    trials = choice.make_trials(GapQuestion(waves().hide(mask), mask), np.random.default_rng(0))[:3]
    workers = Slow()
    race(["linear", "hold"], trials, workers, 64.0, lambda *_: None)
    models = [model for model, _ in workers.limits]
    assert models == ["linear", "hold", *["linear"] * 3, *["hold"] * 3]


class TwoSlow(Slow):
    """Two workers, of which the one that began first ends first."""

    count = 2


def test_from_its_first_answer_on_all_workers_try_a_slow_model(waves, hidden):
    mask = hidden((50, 58, [0]))
    trials = choice.make_trials(GapQuestion(waves().hide(mask), mask), np.random.default_rng(0))[:4]
    workers = TwoSlow()
    linear, hold = race(["linear", "hold"], trials, workers, 64.0, lambda *_: None)
    models = [model for model, _ in workers.limits][2:]
    assert models == ["linear", "hold", *["linear"] * 3, *["hold"] * 3]
    assert len(linear.answers) == len(hold.answers) == 4


class Scripted:
    """Two workers on a clock of their own, for which attempts take as long as a script says."""

    count = 2

    def __init__(self, seconds, failing=()):
        self.seconds, self.failing = seconds, failing
        self.now, self.tried, self.ends = 0.0, [], {}

    def keep(self, question):
        self.tried.append([])
        return len(self.tried) - 1

    def submit(self, model, question, seconds, method):
        self.tried[question].append(model)
        took = self.seconds[model][question]
        attempt = Attempt(FilledEntries(np.zeros(1), None), seconds=took)
        if took > seconds:
            attempt = Attempt(None, "was stopped", seconds=seconds, slow=True)
        elif (model, question) in self.failing:
            attempt = Attempt(None, "cannot do it", seconds=took)
        future = Future()
        future.set_result(attempt)
        self.ends[future] = self.now + min(took, seconds)
        return future

    def ended(self, futures):
        first = min(futures, key=self.ends.__getitem__)
        self.now = self.ends[first]
        return [first]

    def result(self, future):
        return future.result()


@pytest.fixture
def raced(waves, hidden, monkeypatch):
    """Return a function from what models take in six trials to the runners and the workers."""
    mask = hidden((50, 58, [0]))
    trials = choice.make_trials(GapQuestion(waves().hide(mask), mask), np.random.default_rng(0))[:6]

    def run(seconds, failing=(), budget=32.0):
        workers = Scripted(seconds, failing)
        monkeypatch.setattr(time, "monotonic", lambda: workers.now)
        return race([*seconds], trials, workers, budget, lambda *_: None), workers

    return run


def test_a_model_that_fails_in_a_trial_tries_no_other(raced):
    (runner,), workers = raced({"one": [2.0] * 6}, failing={("one", 1)})
    assert (len(runner.answers), runner.trouble, runner.late) == (1, "cannot do it", False)
    assert [len(models) for models in workers.tried] == [2, 1, 1, 0, 0, 0]


def test_an_answer_that_comes_after_a_failure_in_a_later_trial_counts(raced):
    (runner,), _ = raced({"one": [2.0, 2.0, 3.0, 2.9, 2.0, 2.0]}, failing={("one", 3)})
    assert (len(runner.answers), runner.trouble) == (3, "cannot do it")


def test_models_that_were_stopped_later_keep_their_turn(raced):
    """One answers three trials before it is stopped; the others are stopped at once."""
    slow = {name: [1.9] * 6 for name in ("two", "three", "four", "five", "six")}
    (one, *others), _ = raced({"one": [0.4] * 3 + [0.8] * 3, **slow}, budget=16.0)
    assert len(one.answers) == 6
    assert len(others[-1].answers) < 6


def test_no_trial_is_done_again_that_was_answered(raced):
    (runner,), workers = raced({"one": [2.0, 2.0, 2.0, 5.0, 2.0, 2.0]})
    assert len(runner.answers) == 6
    assert [len(models) for models in workers.tried] == [2, 1, 1, 2, 1, 1]


@pytest.mark.parametrize("budget", [8.0, 16.0, 32.0])
def test_the_race_ends_with_its_budget(raced, budget):
    seconds = {name: [number / 2.0] * 6 for number, name in enumerate("abcdefgh", start=1)}
    _, workers = raced(seconds, budget=budget)
    assert workers.now <= budget
