from dataclasses import replace

import numpy as np
import pytest
from fill_workers import Here

from mocapbench.baselines import Imputer, Prediction
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.choosing import choice
from mocapbench.benchmark.filling.choosing.choice import choose
from mocapbench.benchmark.filling.choosing.schedule import Contender
from mocapbench.benchmark.filling.gap_problem import GapProblem, PredictedEntries
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


@pytest.fixture
def few_models(monkeypatch):
    MODELS.add("remembers", Remembers)
    names = ("hold", "linear", "cubic-spline", "remembers")
    monkeypatch.setattr(choice, "find_candidates", lambda problem: names)


@pytest.mark.usefixtures("few_models")
def test_smooth_curves_are_filled_by_the_smooth_model(waves, hidden):
    mask = hidden((50, 58, [0, 2]))
    chosen = choose(GapProblem(waves().hide(mask), mask), Here(), 60.0, lambda *_: None)
    assert chosen.ranking.order[0] == "cubic-spline"
    assert chosen.ranking.order[-1] in {"hold", "remembers"}


@pytest.mark.usefixtures("few_models")
def test_standing_still_is_not_filled_with_the_motion_of_training(waves, hidden):
    mask = hidden((50, 80, [0, 1, 2, 3]))
    still = waves().with_values(np.tile([10.0, -5.0, 3.0, 90.0], (200, 1)))
    problem = GapProblem(still.hide(mask), mask, (waves(name="walk"),))
    chosen = choose(problem, Here(), 60.0, lambda *_: None)
    assert chosen.ranking.order[-1] == "remembers"
    assert chosen.ranking.means[chosen.ranking.order[0]] < 1e-8  # of rounding


@pytest.mark.usefixtures("few_models")
def test_what_training_knows_is_filled_from_it(waves, hidden):
    mask = hidden((50, 90, [0, 1, 2, 3]))
    problem = GapProblem(waves().hide(mask), mask, (waves(name="same"),))
    assert choose(problem, Here(), 60.0, lambda *_: None).ranking.order[0] != "hold"


@pytest.mark.usefixtures("few_models")
def test_models_that_are_too_slow_have_no_rank_and_say_why(waves, hidden):
    mask = hidden((50, 58, [0]))
    workers = Here(slow=("cubic-spline",))
    chosen = choose(GapProblem(waves().hide(mask), mask), workers, 64.0, lambda *_: None)
    assert ("cubic-spline", "took longer") in [(r.model, r.failure) for r in chosen.left_out]
    assert "cubic-spline" not in chosen.ranking.order
    limits = [seconds for model, seconds in workers.limits if model == "cubic-spline"]
    assert limits == [2.0, 8.0, 32.0]


@pytest.mark.usefixtures("few_models")
def test_hidden_values_do_not_matter(waves, hidden):
    mask = hidden((50, 58, [0, 2]), (120, 140, [1]))
    other = waves().values.copy()
    other[mask] = 1e6
    means = [
        choose(GapProblem(recording.hide(mask), mask), Here(), 60.0, lambda *_: None).ranking.means
        for recording in (waves(), waves().with_values(other))
    ]
    assert means[0] == means[1]


@pytest.mark.usefixtures("few_models")
def test_without_room_for_a_hold_out_a_model_has_to_be_named(waves, hidden):
    mask = hidden((1, 199, [0, 1, 2, 3]))
    with pytest.raises(UsageError, match=r"expected a visible stretch to try models on.*linear"):
        choose(GapProblem(waves().hide(mask), mask), Here(), 60.0, lambda *_: None)


@pytest.mark.parametrize(("n_train", "advised"), [(1, False), (2, True)])
def test_for_a_channel_visible_nowhere_a_model_that_tries_others_in_training_is_named(
    waves, hidden, n_train, advised
):
    mask = hidden((0, 200, [0]))
    given, *train = (replace(waves(), name=f"r{number}") for number in range(1 + n_train))
    with pytest.raises(UsageError, match="name a model") as refused:
        choose(GapProblem(given.hide(mask), mask, tuple(train)), Here(), 60.0, lambda *_: None)
    assert ("best-of tries others" in str(refused.value)) is advised


@pytest.mark.usefixtures("few_models")
def test_without_an_prediction_in_time_the_budget_is_to_be_raised(waves, hidden):
    mask = hidden((50, 58, [0]))
    workers = Here(slow=("hold", "linear", "cubic-spline", "remembers"))
    with pytest.raises(UsageError, match="raise --budget"):
        choose(GapProblem(waves().hide(mask), mask), workers, 60.0, lambda *_: None)


@pytest.fixture
def only(monkeypatch):
    """Return a function that leaves a single model to choose from."""
    MODELS.add("intervals", Intervals)
    return lambda name: monkeypatch.setattr(choice, "find_candidates", lambda problem: (name,))


def test_models_are_compared_without_checks_and_the_intervals_of_the_best_are_checked(
    held_out, waves, hidden, only
):
    only("intervals")
    mask, workers = hidden((50, 58, [0])), Here()
    chosen = choose(GapProblem(waves().hide(mask), mask), workers, 64.0, lambda *_: None)
    assert np.concatenate(chosen.in_intervals).all()
    first = held_out(mask)[:3]
    assert len(np.concatenate(chosen.in_intervals)) == sum(
        len(hold_out.truth) for hold_out in first
    )
    assert len(chosen.in_intervals) == sum(len(hold_out.entries) for hold_out in first)
    assert workers.asked == ["impute_uncalibrated"] * (len(workers.asked) - 3) + ["impute"] * 3
    in_two_waves = [seconds for _, seconds in workers.limits[-3:]]
    assert 2 * max(in_two_waves) <= 0.5 * 64.0


def test_intervals_that_there_are_not_or_not_in_time_hold_nothing(waves, hidden, only):
    mask = hidden((50, 58, [0]))
    problem = GapProblem(waves().hide(mask), mask)
    only("linear")
    workers = Here()
    assert choose(problem, workers, 64.0, lambda *_: None).in_intervals == ()
    assert set(workers.asked) == {"impute_uncalibrated"}
    only("intervals")
    workers = SlowToCalibrate()
    assert choose(problem, workers, 64.0, lambda *_: None).in_intervals == ()
    assert "impute" in workers.asked


class SlowToCalibrate(Here):
    """Workers that calibrate no intervals in time."""

    def submit(self, model, problem, seconds, method):
        self.slow = (model,) if method == "impute" else ()
        return super().submit(model, problem, seconds, method)


@pytest.fixture
def chosen_of(held_out, waves, hidden, monkeypatch):
    """Return a function from the errors of models in each hold-out to the choice among them."""
    mask = hidden((50, 58, [0, 1]))
    problem = GapProblem(waves().hide(mask), mask)
    hold_outs = held_out(mask)

    def chosen(errors):
        found = [Contender(model) for model in errors]
        for contender, off in zip(found, errors.values(), strict=True):
            pairs = zip(hold_outs, off, strict=False)
            predictions = [
                PredictedEntries(hold_out.truth + error, None) for hold_out, error in pairs
            ]
            contender.predicted = dict(enumerate(predictions))
        monkeypatch.setattr(choice, "run_rounds", lambda *_: found)
        return choose(problem, Here(), 60.0, lambda *_: None).ranking

    chosen.n = len(hold_outs)
    assert chosen.n >= 8
    return chosen


def test_fewer_hold_outs_count_only_if_they_have_copies_of_all_gaps(waves, hidden):
    mask = hidden((20, 24, [0]), (60, 64, [1]), (100, 104, [2]))
    hold_outs = choice.make_hold_outs(
        GapProblem(waves().hide(mask), mask), np.random.default_rng(0)
    )
    assert choice._copy_the_same_gaps(hold_outs[:1] * 2, hold_outs[:1])
    one, other = (
        replace(hold_outs[0], originals=hold_outs[0].originals[n : n + 1]) for n in (0, 1)
    )
    assert not choice._copy_the_same_gaps([one], [one, other])


def test_a_model_that_had_fewer_hold_outs_is_chosen_if_it_leads_by_more_than_chance(chosen_of):
    n = chosen_of.n
    errors = {"linear": [2.0, 2.1] * n, "pchip": [2.1, 2.2] * n, "slow": [0.4, 0.5] * (n // 4)}
    ranking = chosen_of({name: off[:n] for name, off in errors.items()})
    assert ranking.order[0] == "slow"
    assert set(ranking.errors) == set(errors)


@pytest.mark.parametrize(
    "slow",
    [[1.9, 2.2, 2.0, 2.1, 1.8], [0.1], [3.0, 3.0, 3.0, 3.0, 3.0]],
    ids=["by chance", "in too few hold-outs", "behind"],
)
def test_a_model_that_had_fewer_hold_outs_is_not_chosen_otherwise(chosen_of, slow):
    n = chosen_of.n
    errors = {"linear": [2.0, 2.1] * n, "pchip": [2.1, 2.2] * n}
    ranking = chosen_of({**{name: off[:n] for name, off in errors.items()}, "slow": slow})
    assert ranking.order == ("linear", "pchip")
    assert ranking.n_gaps >= n


@pytest.mark.parametrize(("counts", "common"), [([8, 3], 8), ([10, 6], 6), ([9, 9, 1], 9)])
def test_models_are_compared_by_the_hold_outs_that_most_predictions_are_of(counts, common):
    contenders = [Contender(f"model {number}") for number in range(len(counts))]
    for contender, count in zip(contenders, counts, strict=True):
        contender.predicted = dict.fromkeys(range(count), PredictedEntries(np.zeros(1), None))
    assert choice._count_common(contenders) == common


def test_a_lead_in_many_gaps_of_few_hold_outs_may_be_chance(waves, hidden):
    """Gaps of a hold-out share one fit: five in two hold-outs are two findings, not five."""
    mask = hidden((20, 22, [0]), (60, 62, [1]), (100, 102, [2]), (140, 142, [0]))
    hold_outs = choice.make_hold_outs(
        GapProblem(waves().hide(mask), mask), np.random.default_rng(0)
    )
    assert sum(len(hold_out.entries) for hold_out in hold_outs[:2]) >= 5
    contenders = [Contender("usual"), Contender("slow")]
    for contender, error, n in zip(contenders, (1.0, 0.1), (len(hold_outs), 2), strict=True):
        noise = np.random.default_rng(0)
        predictions = [
            t.truth + error * noise.uniform(0.9, 1.1, t.truth.shape) for t in hold_outs[:n]
        ]
        contender.predicted = dict(
            enumerate(PredictedEntries(prediction, None) for prediction in predictions)
        )
    few = choice._compare_over(hold_outs[:2], contenders)
    assert choice._copy_the_same_gaps(hold_outs[:2], hold_outs)
    assert few.ranking.sharing == ("slow",)
    assert choice.compare(hold_outs, contenders).ranking.order == ("usual",)
