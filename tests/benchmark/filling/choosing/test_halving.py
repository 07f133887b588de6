"""The schedule: which models fill how many hold-outs, by work that is predicted."""

import re

import numpy as np
import pytest
from fill_workers import Here
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.benchmark.filling.choosing import halving
from mocapbench.benchmark.filling.choosing.halving import Contender, run_rungs
from mocapbench.benchmark.filling.choosing.hold_outs import make_hold_outs
from mocapbench.benchmark.filling.choosing.kinds import Kind
from mocapbench.benchmark.filling.choosing.scores import list_gaps
from mocapbench.benchmark.filling.fill_attempt import FillAttempt
from mocapbench.benchmark.filling.gap_problem import GapProblem, PredictedEntries
from mocapbench.datasets import Recording


def hold_out_gaps(n_frames, *blocks):
    target = np.zeros((n_frames, 3), dtype=bool)
    for start, stop, channel in blocks:
        target[start:stop, channel] = True
    values = np.random.default_rng(0).normal(size=target.shape).cumsum(axis=0)
    times = np.arange(n_frames) / 100
    whole = Recording("r", times, values, ("a", "b", "c"), ("mm",) * 3)
    return make_hold_outs(GapProblem(whole.hide(target), target), np.random.default_rng(0))


SHORT = hold_out_gaps(500, (200, 224, 0))
LONG = hold_out_gaps(2000, (1000, 1200, 1))
BOTH = hold_out_gaps(4000, (200, 206, 0), (1000, 1300, 1))
KINDS = {"short": "up to 0.25 s", "long": "longer"}


class Erring(Here):
    """Models err by so many millimetres in gaps of each kind, and by chance a little more or less.

    What is predicted depends on the model and the hold-out alone.
    """

    def __init__(self, hold_outs, errors, **special):
        super().__init__(**special)
        self.numbers = {id(one.problem): n for n, one in enumerate(hold_outs)}
        self.hold_outs, self.errors = hold_outs, errors

    def attempt(self, model, problem, method):
        number = self.numbers[id(problem)]
        if model in self.failing or model in self.stopped or (model, number) in self.failing:
            return FillAttempt(None, "cannot do it", stopped=model in self.stopped)
        hold_out, noise = self.hold_outs[number], np.random.default_rng([number, len(model)])
        mean = hold_out.truth.copy()
        for gap in hold_out.gaps:
            of_kind = self.errors[model]
            error = of_kind if np.isscalar(of_kind) else of_kind[gap.kind.length]
            mean[gap.entries] += error * noise.uniform(0.9, 1.1)
        return FillAttempt(PredictedEntries(mean, None))

    @property
    def filled(self):
        """How many hold-outs each model was given."""
        return {m: sum(m == one[0] for one in self.submitted) for m in self.errors}


@pytest.fixture
def run(monkeypatch):
    """Return a function from the errors of models to how they did, and to the workers."""

    def run(errors, hold_outs=SHORT, work=1e6, costs=None, **special):
        costs = costs or {}
        monkeypatch.setattr(halving, "predict_seconds", lambda model, _: costs.get(model, 1.0))
        workers = Erring(hold_outs, errors, **special)
        contenders = run_rungs([*errors], hold_outs, workers, work, lambda *_: None)
        return {one.model: one for one in contenders}, workers

    return run


def test_a_model_that_is_worse_by_more_than_chance_fills_no_further_hold_outs(run):
    found, workers = run({"good": 1.0, "alike": 1.0, "bad": 3.0})
    assert workers.filled == {"good": len(SHORT), "alike": len(SHORT), "bad": 2}
    ending = r"erred \d\.\d+ times as far as the best in 2 hold-outs, by more than chance"
    assert re.fullmatch(ending, found["bad"].ending)


def test_it_stops_when_one_model_is_the_best_of_each_kind(run):
    assert run({"good": 1.0, "bad": 2.0, "worse": 3.0})[1].filled == {
        "good": 2,
        "bad": 2,
        "worse": 2,
    }
    errors = {"snap": {KINDS["short"]: 1.0, KINDS["long"]: 9.0}, "bad": 20.0}
    errors["slow"] = {KINDS["short"]: 2.0, KINDS["long"]: 4.0}
    _, workers = run(errors, BOTH)
    n = workers.filled["snap"]
    assert workers.filled == {"snap": n, "slow": n, "bad": 2}
    assert n < len(BOTH)


def test_a_model_goes_on_if_it_is_the_best_of_one_kind_however_bad_in_others(run):
    tie = {KINDS["short"]: 1.0, KINDS["long"]: 5.0}
    errors = {"one": tie, "alike": tie, "patient": {KINDS["short"]: 99.0, KINDS["long"]: 5.0}}
    _, workers = run(errors, BOTH)
    assert workers.filled == dict.fromkeys(errors, len(BOTH))


def test_before_any_model_is_dropped_all_have_filled_a_gap_of_each_kind(run):
    hold_outs = [*SHORT[:3], *LONG]
    errors = {"snap": {KINDS["short"]: 1.0, KINDS["long"]: 9.0}}
    errors["patient"] = {KINDS["short"]: 9.0, KINDS["long"]: 1.0}
    _, workers = run(errors, hold_outs)
    assert workers.filled == dict.fromkeys(errors, 4)


def test_a_model_whose_work_exceeds_what_is_left_never_starts(run):
    errors = dict.fromkeys(("one", "dear", "two"), 1.0)
    found, workers = run(errors, work=40.0, costs={"dear": 16.0})
    assert workers.filled["dear"] == 0
    assert found["dear"].ending == "would take 32 s of work, more than --effort leaves"
    assert workers.filled["one"] == workers.filled["two"] >= 4


def test_the_first_hold_outs_take_three_quarters_of_the_work_at_most(run):
    errors = dict.fromkeys(("one", "dear"), 1.0)
    assert run(errors, work=29.0, costs={"dear": 10.0})[1].filled["dear"] == 0
    assert run(errors, work=29.4, costs={"dear": 10.0})[1].filled["dear"] == 2


def test_the_best_is_not_replaced_by_a_worse_one_that_takes_less_work(run):
    """They are alike by the test, and there is work for one of them to fill further hold-outs."""
    errors, costs = {"cheap": 1.05, "best": 1.0}, {"best": 10.0}
    found, workers = run(errors, work=50.0, costs=costs)
    assert workers.filled == {"cheap": 4, "best": 4}
    assert len(found["best"].predictions) == len(found["cheap"].predictions) == 4


COSTS = st.dictionaries(st.sampled_from("abcdef"), st.floats(0.01, 20.0), min_size=1)


@settings(deadline=None, max_examples=50)
@given(COSTS, st.floats(0.0, 500.0), st.randoms(use_true_random=False))
def test_what_is_spent_never_exceeds_the_work_and_the_same_models_start(costs, work, rng):
    """However quick workers are, and in whichever order they end."""
    errors = {model: 1.0 + ord(model) % 3 for model in costs}
    started = []
    for order in (None, rng):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(halving, "predict_seconds", lambda model, _: costs[model])
            workers = Erring(SHORT, errors, rng=order)
            contenders = run_rungs([*costs], SHORT, workers, work, lambda *_: None)
        started.append([model for model, *_ in workers.submitted])
        assert sum(costs[model] for model in started[-1]) <= work
        for one in contenders:
            assert len(one.predictions) == workers.filled[one.model]
    assert started[0] == started[1]


def test_those_that_did_best_have_the_work_that_is_left(run):
    errors = {"first": 1.04, "second": 1.0}
    _, workers = run(errors, work=9.0, costs={})
    assert [model for model, *_ in workers.submitted] == ["first"] * 2 + ["second"] * 2 + [
        "second"
    ] * 2 + ["first"] * 2


def test_a_model_that_fails_is_out_with_its_reason(run):
    errors = dict.fromkeys(("one", "two", "broken"), 1.0)
    found, workers = run(errors, failing=[("broken", 3)])
    assert found["broken"].ending == "cannot do it"
    assert not found["broken"].predictions
    assert not found["broken"].stopped
    assert workers.filled == {"one": len(SHORT), "two": len(SHORT), "broken": 4}


def test_if_all_that_go_on_fail_those_that_filled_as_many_before_are_left(run):
    errors = {"one": 1.0, "two": 1.0, "bad": 3.0}
    found, _ = run(errors, failing=[("one", 2), ("two", 3)])
    assert {model: len(each.predictions) for model, each in found.items()} == {
        "one": 0,
        "two": 0,
        "bad": 2,
    }


def test_if_all_fail_none_has_a_prediction(run):
    found, _ = run({"one": 1.0, "two": 1.0}, failing=["one", "two"])
    assert not any(each.predictions for each in found.values())


def test_a_model_that_exceeds_a_limit_is_told_from_one_that_fails(run):
    found, _ = run(dict.fromkeys(("one", "slow", "bad"), 1.0), stopped=["slow"], failing=["bad"])
    assert {model: each.stopped for model, each in found.items()} == {
        "one": False,
        "slow": True,
        "bad": False,
    }


@pytest.mark.parametrize("numbers", [[], [0, 0], [0, 3, 2]])
def test_windows_are_those_of_the_hold_out_with_the_most_and_none_if_none_was_cut(numbers):
    one, prediction = Contender("a"), PredictedEntries(np.zeros(1), None)
    one.record([FillAttempt(prediction, n_windows=number) for number in numbers])
    assert one.n_windows == max(numbers, default=0)


def test_progress_counts_hold_outs_that_were_filled():
    told = []
    run_rungs(["linear", "hold"], SHORT[:1], Here(), 1e6, lambda *counts: told.append(counts))
    assert told == [(1, 2), (2, 2)]


def test_each_kind_has_a_ranking_of_its_own_gaps(run):
    errors = {"snap": {KINDS["short"]: 1.0, KINDS["long"]: 9.0}}
    errors["patient"] = {KINDS["short"]: 9.0, KINDS["long"]: 1.0}
    found, workers = run(errors, BOTH)
    n = workers.filled["snap"]
    rankings = halving.rank_by_kind([*found.values()], BOTH[:n])
    first = {kind.length: ranking.order[0] for kind, ranking in rankings.items()}
    assert first == {KINDS["short"]: "snap", KINDS["long"]: "patient"}
    assert {*rankings} == {Kind("mm", "one marker or joint", length) for length in KINDS.values()}
    assert sum(one.n_gaps for one in rankings.values()) == len(list_gaps(BOTH[:n]))
