from dataclasses import replace

import numpy as np
import pytest
from fill_workers import Here

from mocapbench.baselines import Imputer, Prediction
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.question import GapQuestion
from mocapbench.benchmark.filling.trials import choice
from mocapbench.benchmark.filling.trials.choice import choose
from mocapbench.benchmark.registry import MODELS


class Remembers(Imputer):
    """Fills with the training recording of the same frames, whatever is beside the gap."""

    def fit(self, recordings):
        self.first_ = recordings[0]
        return self

    def impute(self, recordings):
        return [Prediction.around(r, self.first_.values[: len(r.times)]) for r in recordings]


class Bands(Imputer):
    """Fills with zeros; its bands hold nothing until they are checked, and everything then."""

    def fit(self, recordings):
        return self

    def impute(self, recordings):
        return [Prediction.around(recording, 0.0, 1e4) for recording in recordings]

    def as_claimed(self, recordings):
        return [Prediction.around(recording, 0.0, 1e-12) for recording in recordings]


@pytest.fixture
def few_models(monkeypatch):
    MODELS.add("remembers", Remembers)
    names = ("hold", "linear", "cubic-spline", "remembers")
    monkeypatch.setattr(choice, "able_models", lambda question: names)


@pytest.mark.usefixtures("few_models")
def test_smooth_curves_are_filled_by_the_smooth_model(waves, hidden):
    mask = hidden((50, 58, [0, 2]))
    chosen = choose(GapQuestion(waves().hide(mask), mask), Here(), 60.0, lambda *_: None)
    assert chosen.ranking.order[0] == "cubic-spline"
    assert chosen.ranking.order[-1] in {"hold", "remembers"}


@pytest.mark.usefixtures("few_models")
def test_standing_still_is_not_filled_with_the_motion_of_training(waves, hidden):
    mask = hidden((50, 80, [0, 1, 2, 3]))
    still = waves().with_values(np.tile([10.0, -5.0, 3.0, 90.0], (200, 1)))
    question = GapQuestion(still.hide(mask), mask, (waves(name="walk"),))
    chosen = choose(question, Here(), 60.0, lambda *_: None)
    assert chosen.ranking.order[-1] == "remembers"
    assert chosen.ranking.means[chosen.ranking.order[0]] < 1e-8  # of rounding


@pytest.mark.usefixtures("few_models")
def test_what_training_knows_is_filled_from_it(waves, hidden):
    mask = hidden((50, 90, [0, 1, 2, 3]))
    question = GapQuestion(waves().hide(mask), mask, (waves(name="same"),))
    assert choose(question, Here(), 60.0, lambda *_: None).ranking.order[0] != "hold"


@pytest.mark.usefixtures("few_models")
def test_models_that_are_too_slow_have_no_rank_and_say_why(waves, hidden):
    mask = hidden((50, 58, [0]))
    workers = Here(slow=("cubic-spline",))
    chosen = choose(GapQuestion(waves().hide(mask), mask), workers, 64.0, lambda *_: None)
    assert ("cubic-spline", "took longer") in [(r.model, r.trouble) for r in chosen.left_out]
    assert "cubic-spline" not in chosen.ranking.order
    limits = [seconds for model, seconds in workers.limits if model == "cubic-spline"]
    assert limits == [2.0, 8.0, 32.0]


@pytest.mark.usefixtures("few_models")
def test_hidden_values_do_not_matter(waves, hidden):
    mask = hidden((50, 58, [0, 2]), (120, 140, [1]))
    other = waves().values.copy()
    other[mask] = 1e6
    means = [
        choose(GapQuestion(recording.hide(mask), mask), Here(), 60.0, lambda *_: None).ranking.means
        for recording in (waves(), waves().with_values(other))
    ]
    assert means[0] == means[1]


@pytest.mark.usefixtures("few_models")
def test_without_room_for_a_trial_a_model_has_to_be_named(waves, hidden):
    mask = hidden((1, 199, [0, 1, 2, 3]))
    with pytest.raises(UsageError, match=r"expected a visible stretch to try models on.*linear"):
        choose(GapQuestion(waves().hide(mask), mask), Here(), 60.0, lambda *_: None)


@pytest.mark.parametrize(("n_train", "advised"), [(1, False), (2, True)])
def test_for_a_channel_visible_nowhere_a_model_that_tries_others_in_training_is_named(
    waves, hidden, n_train, advised
):
    mask = hidden((0, 200, [0]))
    given, *train = (replace(waves(), name=f"r{number}") for number in range(1 + n_train))
    with pytest.raises(UsageError, match="name a model") as refused:
        choose(GapQuestion(given.hide(mask), mask, tuple(train)), Here(), 60.0, lambda *_: None)
    assert ("best-of tries others" in str(refused.value)) is advised


@pytest.mark.usefixtures("few_models")
def test_without_an_answer_in_time_the_budget_is_to_be_raised(waves, hidden):
    mask = hidden((50, 58, [0]))
    workers = Here(slow=("hold", "linear", "cubic-spline", "remembers"))
    with pytest.raises(UsageError, match="raise --budget"):
        choose(GapQuestion(waves().hide(mask), mask), workers, 60.0, lambda *_: None)


@pytest.fixture
def only(monkeypatch):
    """Return a function that leaves a single model to choose from."""
    MODELS.add("bands", Bands)
    return lambda name: monkeypatch.setattr(choice, "able_models", lambda question: (name,))


def test_models_are_compared_without_checks_and_the_bands_of_the_best_are_checked(
    waves, hidden, only
):
    only("bands")
    mask, workers = hidden((50, 58, [0])), Here()
    chosen = choose(GapQuestion(waves().hide(mask), mask), workers, 64.0, lambda *_: None)
    assert chosen.coverage.share == 1.0
    first = choice.make_trials(GapQuestion(waves().hide(mask), mask), np.random.default_rng(0))[:3]
    assert chosen.coverage.n_entries == sum(len(trial.truth) for trial in first)
    assert chosen.coverage.n_gaps == sum(len(trial.units) for trial in first)
    assert workers.asked == ["as_claimed"] * (len(workers.asked) - 3) + ["impute"] * 3
    in_two_waves = [seconds for _, seconds in workers.limits[-3:]]
    assert 2 * max(in_two_waves) <= 0.5 * 64.0


def test_bands_that_there_are_not_or_not_in_time_hold_nothing(waves, hidden, only):
    mask = hidden((50, 58, [0]))
    question = GapQuestion(waves().hide(mask), mask)
    only("linear")
    workers = Here()
    assert choose(question, workers, 64.0, lambda *_: None).coverage is None
    assert set(workers.asked) == {"as_claimed"}
    only("bands")
    workers = SlowToCheck()
    assert choose(question, workers, 64.0, lambda *_: None).coverage is None
    assert "impute" in workers.asked


class SlowToCheck(Here):
    """Workers that check no bands in time."""

    def submit(self, model, question, seconds, method):
        self.slow = (model,) if method == "impute" else ()
        return super().submit(model, question, seconds, method)
