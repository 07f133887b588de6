import time
from concurrent.futures import Future
from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines import Imputer, Prediction
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.attempt import Attempt, attempt
from mocapbench.benchmark.filling.question import Answer, Question
from mocapbench.benchmark.filling.trials import choice, comparison
from mocapbench.benchmark.filling.trials.choice import choose
from mocapbench.benchmark.filling.trials.race import race
from mocapbench.benchmark.filling.trials.runner import Runner
from mocapbench.benchmark.filling.trials.scores import held_errors, scores_of, weights_of
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


class Here:
    """Workers of this process, which need no time; slow models take longer than any limit."""

    count = 2

    def __init__(self, slow=()):
        self.slow, self.kept, self.limits, self.asked = slow, [], [], []

    def keep(self, question):
        self.kept.append(question)
        return len(self.kept) - 1

    def submit(self, model, question, seconds, method):
        self.limits.append((model, seconds))
        self.asked.append(method)
        ended = Future()
        if model in self.slow:
            ended.set_result(Attempt(None, "took longer", slow=True))
        else:
            ended.set_result(attempt(MODELS.get(model), self.kept[question], 2**45, method))
        return ended

    def ended(self, futures):
        return list(futures)[:1]

    def result(self, future):
        return future.result()


@pytest.fixture
def few_models(monkeypatch):
    MODELS.add("remembers", Remembers)
    names = ("hold", "linear", "cubic-spline", "remembers")
    monkeypatch.setattr(choice, "able_models", lambda question: names)


@pytest.mark.usefixtures("few_models")
def test_smooth_curves_are_filled_by_the_smooth_model(waves, hidden):
    mask = hidden((50, 58, [0, 2]))
    chosen = choose(Question(waves().hide(mask), mask), Here(), 60.0, lambda *_: None)
    assert chosen.ranking.order[0] == "cubic-spline"
    assert chosen.ranking.order[-1] in {"hold", "remembers"}


@pytest.mark.usefixtures("few_models")
def test_standing_still_is_not_filled_with_the_motion_of_training(waves, hidden):
    mask = hidden((50, 80, [0, 1, 2, 3]))
    still = waves().with_values(np.tile([10.0, -5.0, 3.0, 90.0], (200, 1)))
    question = Question(still.hide(mask), mask, (waves(name="walk"),))
    chosen = choose(question, Here(), 60.0, lambda *_: None)
    assert chosen.ranking.order[-1] == "remembers"
    assert chosen.ranking.means[chosen.ranking.order[0]] < 1e-8  # of rounding


@pytest.mark.usefixtures("few_models")
def test_what_training_knows_is_filled_from_it(waves, hidden):
    mask = hidden((50, 90, [0, 1, 2, 3]))
    question = Question(waves().hide(mask), mask, (waves(name="same"),))
    assert choose(question, Here(), 60.0, lambda *_: None).ranking.order[0] != "hold"


@pytest.mark.usefixtures("few_models")
def test_models_that_are_too_slow_have_no_rank_and_say_why(waves, hidden):
    mask = hidden((50, 58, [0]))
    workers = Here(slow=("cubic-spline",))
    chosen = choose(Question(waves().hide(mask), mask), workers, 64.0, lambda *_: None)
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
        choose(Question(recording.hide(mask), mask), Here(), 60.0, lambda *_: None).ranking.means
        for recording in (waves(), waves().with_values(other))
    ]
    assert means[0] == means[1]


@pytest.mark.usefixtures("few_models")
def test_without_room_for_a_trial_a_model_has_to_be_named(waves, hidden):
    mask = hidden((1, 199, [0, 1, 2, 3]))
    with pytest.raises(UsageError, match=r"expected a visible stretch to try models on.*linear"):
        choose(Question(waves().hide(mask), mask), Here(), 60.0, lambda *_: None)


@pytest.mark.parametrize(("n_train", "advised"), [(1, False), (2, True)])
def test_for_a_channel_visible_nowhere_a_model_that_tries_others_in_training_is_named(
    waves, hidden, n_train, advised
):
    mask = hidden((0, 200, [0]))
    given, *train = (replace(waves(), name=f"r{number}") for number in range(1 + n_train))
    with pytest.raises(UsageError, match="name a model") as refused:
        choose(Question(given.hide(mask), mask, tuple(train)), Here(), 60.0, lambda *_: None)
    assert ("best-of tries others" in str(refused.value)) is advised


@pytest.mark.usefixtures("few_models")
def test_without_an_answer_in_time_the_budget_is_to_be_raised(waves, hidden):
    mask = hidden((50, 58, [0]))
    workers = Here(slow=("hold", "linear", "cubic-spline", "remembers"))
    with pytest.raises(UsageError, match="raise --budget"):
        choose(Question(waves().hide(mask), mask), workers, 60.0, lambda *_: None)


def test_nothing_starts_after_the_budget(waves, hidden):
    mask = hidden((50, 58, [0]))
    trial = choice.make_trials(Question(waves().hide(mask), mask), np.random.default_rng(0))[0]
    workers = Here()
    (runner,) = race(["linear"], [trial], workers, 0.0, lambda *_: None)
    assert not workers.limits
    assert "budget" in runner.trouble
    assert runner.late


def test_models_that_are_slow_are_late_and_no_others(waves, hidden):
    mask = hidden((50, 58, [0]))
    trial = choice.make_trials(Question(waves().hide(mask), mask), np.random.default_rng(0))[0]
    runners = race(["linear", "hold"], [trial], Here(slow=("hold",)), 60.0, lambda *_: None)
    assert {runner.model: runner.late for runner in runners} == {"linear": False, "hold": True}


def test_progress_counts_answers(waves, hidden):
    mask = hidden((50, 58, [0]))
    trials = choice.make_trials(Question(waves().hide(mask), mask), np.random.default_rng(0))[:2]
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
    trials = choice.make_trials(Question(waves().hide(mask), mask), np.random.default_rng(0))[:3]
    workers = Slow()
    race(["linear", "hold"], trials, workers, 64.0, lambda *_: None)
    models = [model for model, _ in workers.limits]
    assert models == ["linear", "hold", *["linear"] * 3, *["hold"] * 3]


class TwoSlow(Slow):
    """Two workers, of which the one that began first ends first."""

    count = 2


def test_from_its_first_answer_on_all_workers_try_a_slow_model(waves, hidden):
    mask = hidden((50, 58, [0]))
    trials = choice.make_trials(Question(waves().hide(mask), mask), np.random.default_rng(0))[:4]
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
        attempt = Attempt(Answer(np.zeros(1), None), seconds=took)
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
    trials = choice.make_trials(Question(waves().hide(mask), mask), np.random.default_rng(0))[:6]

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
    chosen = choose(Question(waves().hide(mask), mask), workers, 64.0, lambda *_: None)
    assert chosen.coverage.share == 1.0
    first = choice.make_trials(Question(waves().hide(mask), mask), np.random.default_rng(0))[:3]
    assert chosen.coverage.n_entries == sum(len(trial.truth) for trial in first)
    assert chosen.coverage.n_gaps == sum(len(trial.units) for trial in first)
    assert workers.asked == ["as_claimed"] * (len(workers.asked) - 3) + ["impute"] * 3
    in_two_waves = [seconds for _, seconds in workers.limits[-3:]]
    assert 2 * max(in_two_waves) <= 0.5 * 64.0


def test_bands_that_there_are_not_or_not_in_time_hold_nothing(waves, hidden, only):
    mask = hidden((50, 58, [0]))
    question = Question(waves().hide(mask), mask)
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


def test_scores_are_closed_forms(waves, hidden):
    mask = hidden((50, 54, [0, 3]))
    question = Question(waves().hide(mask), mask)
    trial = choice.make_trials(question, np.random.default_rng(0))[0]
    wanted = trial.question.target
    truth = trial.truth
    off = np.where(np.nonzero(wanted)[1] == 3, 2.0, 1.0)
    answer = Answer(truth + off, np.full(truth.shape, (1.5 / 1.96) ** 2))
    scores = scores_of([trial], [answer], {"deg": 1.0, "cm": 2.0})
    np.testing.assert_allclose(scores.errors, 1.0)
    assert scores.rmse == pytest.approx({"deg": 1.0, "cm": 2.0})
    assert scores.has_bands


def test_each_unit_counts_alike_however_many_channels_have_it(waves, hidden):
    """Three channels in degrees and one in centimetres."""
    mask = hidden((50, 54, [0, 1, 2, 3]))
    trial = choice.make_trials(Question(waves().hide(mask), mask), np.random.default_rng(0))[0]
    in_cm = np.nonzero(trial.question.target)[1] == 3
    scales = {"deg": 1.0, "cm": 1.0}
    near, far = (
        scores_of([trial], [Answer(trial.truth + off, None)], scales).errors[0]
        for off in (np.where(in_cm, 0.1, 1.2), np.where(in_cm, 1.5, 1.0))
    )
    assert (near, far) == pytest.approx((0.65, 1.25))


def test_scales_are_the_errors_of_the_model_that_holds(waves, hidden):
    mask = hidden((0, 5, [1]), (50, 58, [0, 3]), (120, 150, [3]))
    trials = choice.make_trials(Question(waves().hide(mask), mask), np.random.default_rng(0))
    answers = [attempt(MODELS.get("hold"), trial.question, 2**45).answer for trial in trials]
    scales = held_errors(trials)
    assert scores_of(trials, answers, scales).rmse == pytest.approx(scales, rel=1e-12)
    assert min(scales.values()) > 0.0


def test_what_does_not_move_has_a_scale_of_one(waves, hidden):
    mask = hidden((50, 58, [0, 3]))
    still = waves().with_values(np.where(np.arange(4) == 3, 90.0, waves().values))
    trials = choice.make_trials(Question(still.hide(mask), mask), np.random.default_rng(0))
    scales = held_errors(trials)
    assert scales["cm"] == 1.0
    assert scales["deg"] > 1.0


def test_a_unit_without_error_does_not_outweigh_the_others(waves, hidden):
    """Where a body stands still, an interpolation is exact there and may be bad elsewhere."""
    mask = hidden((50, 54, [0, 1, 2, 3]))
    trial = choice.make_trials(Question(waves().hide(mask), mask), np.random.default_rng(0))[0]
    units = np.nonzero(trial.question.target)[1] == 3
    exact_there, good = (
        scores_of([trial], [Answer(trial.truth + off, None)], {"deg": 1.0, "cm": 1.0}).errors[0]
        for off in (np.where(units, 0.0, 1.0), np.where(units, 1e-6, 0.01))
    )
    assert good < exact_there


def test_errors_of_rounding_are_no_lead(waves, hidden):
    mask = hidden((50, 54, [0]))
    trial = choice.make_trials(Question(waves().hide(mask), mask), np.random.default_rng(0))[0]
    exact, rounded = (
        scores_of([trial], [Answer(trial.truth + off, None)], {"deg": 1.0, "cm": 1.0}).errors
        for off in (0.0, 1e-13)
    )
    np.testing.assert_array_equal(exact, rounded)


def test_a_gap_counts_by_its_entries_however_many_copies_it_has(waves, hidden):
    mask = hidden((0, 10, [0]), (60, 90, [1, 2]), (150, 155, [3]))
    trials = choice.make_trials(Question(waves().hide(mask), mask), np.random.default_rng(0))
    weights = weights_of(trials)
    originals = [original for trial in trials for original in trial.originals]
    totals = {e.n_entries: 0.0 for e in originals}
    for weight, original in zip(weights, originals, strict=True):
        totals[original.n_entries] += weight
    assert weights.mean() == pytest.approx(1.0)
    shares = {entries: total / len(weights) for entries, total in totals.items()}
    assert shares == pytest.approx({10: 10 / 75, 60: 60 / 75, 5: 5 / 75})


@pytest.fixture
def chosen_of(waves, hidden, monkeypatch):
    """Return a function from the errors of models, trial by trial, to the choice among them."""
    mask = hidden((50, 58, [0, 1]))
    question = Question(waves().hide(mask), mask)
    trials = choice.make_trials(question, np.random.default_rng(0))

    def chosen(errors):
        found = [Runner(model) for model in errors]
        for runner, off in zip(found, errors.values(), strict=True):
            pairs = zip(trials, off, strict=False)
            answers = [Answer(trial.truth + error, None) for trial, error in pairs]
            runner.found = dict(enumerate(answers))
        monkeypatch.setattr(choice, "race", lambda *_: found)
        return choose(question, Here(), 60.0, lambda *_: None).ranking

    chosen.n = len(trials)
    assert chosen.n >= 8
    return chosen


def test_fewer_trials_count_only_if_they_have_copies_of_all_gaps(waves, hidden):
    mask = hidden((20, 24, [0]), (60, 64, [1]), (100, 104, [2]))
    trials = choice.make_trials(Question(waves().hide(mask), mask), np.random.default_rng(0))
    assert comparison._of_all_gaps(trials[:1] * 2, trials[:1])
    one, other = (replace(trials[0], originals=trials[0].originals[n : n + 1]) for n in (0, 1))
    assert not comparison._of_all_gaps([one], [one, other])


def test_a_model_that_had_fewer_trials_is_chosen_if_it_leads_by_more_than_chance(chosen_of):
    n = chosen_of.n
    errors = {"linear": [2.0, 2.1] * n, "pchip": [2.1, 2.2] * n, "slow": [0.4, 0.5] * (n // 4)}
    ranking = chosen_of({name: off[:n] for name, off in errors.items()})
    assert ranking.order[0] == "slow"
    assert set(ranking.scores) == set(errors)


@pytest.mark.parametrize(
    "slow",
    [[1.9, 2.2, 2.0, 2.1, 1.8], [0.1], [3.0, 3.0, 3.0, 3.0, 3.0]],
    ids=["by chance", "in too few trials", "behind"],
)
def test_a_model_that_had_fewer_trials_is_not_chosen_otherwise(chosen_of, slow):
    n = chosen_of.n
    errors = {"linear": [2.0, 2.1] * n, "pchip": [2.1, 2.2] * n}
    ranking = chosen_of({**{name: off[:n] for name, off in errors.items()}, "slow": slow})
    assert ranking.order == ("linear", "pchip")
    assert ranking.n >= n
