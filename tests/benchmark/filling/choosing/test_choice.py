"""The choice of a model for each kind of gap."""

from dataclasses import replace

import numpy as np
import pytest
from fill_workers import Here

from mocapbench.baselines import Imputer, Prediction
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.choosing import choice, halving
from mocapbench.benchmark.filling.choosing.choice import Choice, choose, require_room
from mocapbench.benchmark.filling.choosing.kinds import Kind
from mocapbench.benchmark.filling.choosing.ranking import rank
from mocapbench.benchmark.filling.choosing.scores import list_gaps
from mocapbench.benchmark.filling.gap_problem import GapProblem
from mocapbench.benchmark.registry import MODELS


class Remembers(Imputer):
    """Fills with the training recording of the same frames, whatever is beside the gap."""

    def fit(self, recordings):
        self.first_ = recordings[0]
        return self

    def impute(self, recordings):
        return [Prediction.around(r, self.first_.values[: len(r.times)]) for r in recordings]


class Intervals(Imputer):
    """Fills with zeros; its intervals hold nothing until they are calibrated, and all then."""

    def fit(self, recordings):
        return self

    def impute(self, recordings):
        return [Prediction.around(recording, 0.0, 1e4) for recording in recordings]

    def impute_uncalibrated(self, recordings):
        return [Prediction.around(recording, 0.0, 1e-12) for recording in recordings]


class Steadfast(Intervals):
    """Fills, but not with calibrated intervals."""

    def impute(self, recordings):
        raise ValueError("expected more to be visible")


@pytest.fixture
def only(monkeypatch):
    """Return a function that leaves a few models to choose from, which take little work."""
    for module in (choice, halving):
        monkeypatch.setattr(module, "predict_seconds", lambda *_: 0.01)
    monkeypatch.setattr(choice, "predict_calibrated_seconds", lambda *_: 0.03)
    MODELS.add("remembers", Remembers)
    MODELS.add("intervals", Intervals)
    return lambda *names: monkeypatch.setattr(choice, "find_candidates", lambda _: names)


@pytest.fixture
def few_models(only):
    only("hold", "linear", "cubic-spline", "remembers")


def choose_for(problem, workers=None, effort="normal"):
    return choose(problem, workers or Here(), effort, lambda *_: None)


def only_ranking(chosen):
    (ranking,) = chosen.rankings.values()
    return ranking


@pytest.mark.usefixtures("few_models")
def test_smooth_curves_are_filled_by_the_smooth_model(waves, hidden):
    mask = hidden((50, 58, [0, 2]))
    ranking = only_ranking(choose_for(GapProblem(waves().hide(mask), mask)))
    assert ranking.order[0] == "cubic-spline"
    assert ranking.order[-1] in {"hold", "remembers"}


@pytest.mark.usefixtures("few_models")
def test_standing_still_is_not_filled_with_the_motion_of_training(waves, hidden):
    mask = hidden((50, 80, [0, 1, 2, 3]))
    still = waves().with_values(np.tile([10.0, -5.0, 3.0, 90.0], (200, 1)))
    problem = GapProblem(still.hide(mask), mask, (waves(name="walk"),))
    for ranking in choose_for(problem).rankings.values():
        assert "remembers" not in ranking.order[:-1]
        assert ranking.means[ranking.order[0]] < 1e-6  # of rounding


@pytest.mark.usefixtures("few_models")
def test_what_training_knows_is_filled_from_it(waves, hidden):
    mask = hidden((50, 90, [0, 1, 2, 3]))
    chosen = choose_for(GapProblem(waves().hide(mask), mask, (waves(name="same"),)))
    assert {ranking.order[0] == "hold" for ranking in chosen.rankings.values()} == {False}


@pytest.mark.usefixtures("few_models")
def test_models_that_exceed_a_limit_have_no_rank_say_why_and_are_named(waves, hidden):
    mask = hidden((50, 58, [0]))
    problem = GapProblem(waves().hide(mask), mask)
    chosen = choose_for(problem, Here(stopped=("cubic-spline",), failing=("hold",)))
    endings = {one.model: one.ending for one in chosen.contenders}
    assert endings["cubic-spline"] == "was stopped"
    assert endings["hold"] == "cannot do it"
    assert not {"cubic-spline", "hold"} & {*only_ranking(chosen).order}
    assert chosen.stopped == ("cubic-spline",)
    assert choose_for(problem).stopped == ()


@pytest.mark.usefixtures("few_models")
def test_hidden_values_do_not_matter(waves, hidden):
    mask = hidden((50, 58, [0, 2]), (120, 140, [1]))
    other = waves().values.copy()
    other[mask] = 1e6
    rankings = [
        choose_for(GapProblem(recording.hide(mask), mask)).rankings
        for recording in (waves(), waves().with_values(other))
    ]
    assert [r.means for r in rankings[0].values()] == [r.means for r in rankings[1].values()]


@pytest.mark.usefixtures("few_models")
def test_without_room_for_a_hold_out_a_model_has_to_be_named(waves, hidden):
    mask = hidden((1, 199, [0, 1, 2, 3]))
    problem = GapProblem(waves().hide(mask), mask)
    with pytest.raises(UsageError, match=r"expected a visible stretch to try models on.*linear"):
        choose_for(problem)
    with pytest.raises(UsageError, match=r"expected a visible stretch to try models on.*linear"):
        require_room(problem, 0)


@pytest.mark.parametrize(("n_train", "advised"), [(1, False), (2, True)])
def test_for_a_channel_visible_nowhere_a_model_that_tries_others_in_training_is_named(
    waves, hidden, n_train, advised
):
    mask = hidden((0, 200, [0]))
    given, *train = (replace(waves(), name=f"r{number}") for number in range(1 + n_train))
    with pytest.raises(UsageError, match="name a model") as refused:
        choose_for(GapProblem(given.hide(mask), mask, tuple(train)))
    assert ("best-of tries others" in str(refused.value)) is advised


@pytest.mark.usefixtures("few_models")
def test_if_no_model_fills_a_held_out_gap_one_is_to_be_named_and_why_is_said(waves, hidden):
    mask = hidden((50, 58, [0]))
    workers = Here(failing=("hold", "linear", "cubic-spline", "remembers"))
    with pytest.raises(UsageError, match=r"got none \(hold: cannot do it\); name a model"):
        choose_for(GapProblem(waves().hide(mask), mask), workers)


@pytest.mark.usefixtures("few_models")
@pytest.mark.parametrize(
    ("effort", "dear"),
    [("low", ("linear", "remembers")), ("normal", ("remembers",)), ("high", ())],
)
def test_models_that_take_too_much_work_to_fill_the_file_are_left_out_beforehand(
    waves, hidden, monkeypatch, effort, dear
):
    seconds = {"linear": 5.0, "remembers": 100.0}
    monkeypatch.setattr(choice, "predict_seconds", lambda model, _: seconds.get(model, 0.1))
    mask, workers = hidden((50, 58, [0])), Here()
    chosen = choose_for(GapProblem(waves().hide(mask), mask), workers, effort)
    assert chosen.too_dear == dear
    assert not {*dear} & {model for model, *_ in workers.submitted}
    assert not {*dear} & {one.model for one in chosen.contenders}


@pytest.mark.usefixtures("few_models")
def test_if_every_model_takes_too_much_work_more_effort_is_advised(waves, hidden, monkeypatch):
    monkeypatch.setattr(choice, "predict_seconds", lambda *_: 1e9)
    mask = hidden((50, 58, [0]))
    with pytest.raises(UsageError, match="raise --effort, or name a model with --model: hold"):
        choose_for(GapProblem(waves().hide(mask), mask))


@pytest.mark.usefixtures("few_models")
def test_what_is_allowed_is_not_exceeded_however_many_models_there_are(waves, hidden, monkeypatch):
    monkeypatch.setattr(halving, "predict_seconds", lambda *_: 0.7)
    mask = hidden((50, 58, [0]), (100, 130, [1]))
    for effort, (once, per_entries) in choice.EFFORTS.items():
        workers = Here()
        choose_for(GapProblem(waves().hide(mask), mask), workers, effort)
        compared = [one for one in workers.submitted if one[-1] == "impute_uncalibrated"]
        assert 0.7 * len(compared) <= once + per_entries * 800 / 100_000


def test_models_are_compared_without_calibration_and_the_intervals_of_the_best_are_checked(
    waves, hidden, only
):
    only("intervals")
    mask, workers = hidden((50, 58, [0])), Here()
    chosen = choose_for(GapProblem(waves().hide(mask), mask), workers)
    first = chosen.hold_outs[:3]
    ((kind, inside),) = chosen.in_intervals.items()
    assert kind in chosen.rankings
    assert inside.all()
    assert len(inside) == sum(len(hold_out.truth) for hold_out in first)
    asked = [method for *_, method in workers.submitted]
    n = len(asked) - len(first)
    assert asked == ["impute_uncalibrated"] * n + ["impute"] * len(first)


def test_intervals_are_checked_in_gaps_of_every_kind(waves, hidden, only, monkeypatch):
    """However few hold-outs are checked, those with the first gap of a kind are among them."""
    only("intervals")
    monkeypatch.setattr(choice, "_CHECKED", 0)
    mask = hidden((20, 24, [0]), (50, 90, [1]), (120, 180, [2]))
    chosen = choose_for(GapProblem(waves().hide(mask), mask))
    assert len(chosen.rankings) == 3
    assert {*chosen.in_intervals} == {*chosen.rankings}


def test_a_model_that_cannot_be_calibrated_is_chosen_without_intervals(waves, hidden, only):
    only("steadfast")
    MODELS.add("steadfast", Steadfast)
    mask = hidden((50, 58, [0]))
    chosen = choose_for(GapProblem(waves().hide(mask), mask))
    assert only_ranking(chosen).order == ("steadfast",)
    assert chosen.with_intervals == {"steadfast"}
    assert not chosen.in_intervals


def test_of_a_model_without_intervals_none_are_checked(waves, hidden, only):
    only("linear")
    mask, workers = hidden((50, 58, [0])), Here()
    assert not choose_for(GapProblem(waves().hide(mask), mask), workers).in_intervals
    assert {method for *_, method in workers.submitted} == {"impute_uncalibrated"}


def test_intervals_that_take_too_much_work_are_not_checked(waves, hidden, only, monkeypatch):
    only("intervals")
    mask, workers = hidden((50, 58, [0])), Here()
    monkeypatch.setattr(choice, "predict_calibrated_seconds", lambda *_: 70.0)
    chosen = choose_for(GapProblem(waves().hide(mask), mask), workers)
    assert not chosen.in_intervals
    assert chosen.with_intervals == {"intervals"}
    assert {method for *_, method in workers.submitted} == {"impute_uncalibrated"}


def test_the_choice_for_a_kind_without_copies_is_that_for_the_one_most_like_it(choice_of):
    kinds = {
        Kind("deg", "whole frames", "longer"): "one",
        Kind("deg", "one marker or joint", "longer"): "two",
        Kind("deg", "one marker or joint", "up to 1 s"): "three",
        Kind("mm", "one marker or joint", "up to 0.25 s"): "four",
    }
    rankings = {k: rank({m: np.ones(5)}, np.ones(5), np.arange(5)) for k, m in kinds.items()}
    chosen = Choice(rankings, (), ())

    def find(*kind):
        return chosen.find_ranking(Kind(*kind)).order[0]

    for kind, model in kinds.items():
        assert find(*kind) == model
    assert find("deg", "whole frames", "up to 0.25 s") == "one"
    assert find("deg", "several markers or joints", "up to 1 s") == "three"
    assert find("mm", "whole frames", "longer") == "four"


def test_the_share_of_a_kind_is_that_of_its_shortest_copies(held_out, hidden):
    hold_outs = held_out(hidden((40, 150, [0]), (170, 175, [1])))
    shares = Choice({}, tuple(hold_outs), ()).shares
    lengths = {kind.length: share for kind, share in shares.items()}
    assert lengths["up to 0.25 s"] == 1.0
    assert lengths["longer"] == min(
        len(gap.copy) / len(gap.original)
        for gap in list_gaps(hold_outs)
        if gap.kind.length == "longer"
    )
    assert lengths["longer"] < 1.0
