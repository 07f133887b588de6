from dataclasses import replace

import numpy as np
import pytest
from fill_workers import Here

from mocapbench.benchmark.filling.question import FilledEntries, GapQuestion
from mocapbench.benchmark.filling.trials import choice, comparison
from mocapbench.benchmark.filling.trials.choice import choose
from mocapbench.benchmark.filling.trials.runner import Runner


@pytest.fixture
def chosen_of(waves, hidden, monkeypatch):
    """Return a function from the errors of models, trial by trial, to the choice among them."""
    mask = hidden((50, 58, [0, 1]))
    question = GapQuestion(waves().hide(mask), mask)
    trials = choice.make_trials(question, np.random.default_rng(0))

    def chosen(errors):
        found = [Runner(model) for model in errors]
        for runner, off in zip(found, errors.values(), strict=True):
            pairs = zip(trials, off, strict=False)
            answers = [FilledEntries(trial.truth + error, None) for trial, error in pairs]
            runner.found = dict(enumerate(answers))
        monkeypatch.setattr(choice, "race", lambda *_: found)
        return choose(question, Here(), 60.0, lambda *_: None).ranking

    chosen.n = len(trials)
    assert chosen.n >= 8
    return chosen


def test_fewer_trials_count_only_if_they_have_copies_of_all_gaps(waves, hidden):
    mask = hidden((20, 24, [0]), (60, 64, [1]), (100, 104, [2]))
    trials = choice.make_trials(GapQuestion(waves().hide(mask), mask), np.random.default_rng(0))
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


@pytest.mark.parametrize(("counts", "common"), [([8, 3], 8), ([10, 6], 6), ([9, 9, 1], 9)])
def test_models_are_compared_by_the_trials_that_most_answers_are_of(counts, common):
    runners = [Runner(f"model {number}") for number in range(len(counts))]
    for runner, count in zip(runners, counts, strict=True):
        runner.found = dict.fromkeys(range(count), FilledEntries(np.zeros(1), None))
    assert comparison._common(runners) == common


def test_a_lead_in_many_gaps_of_few_trials_may_be_chance(waves, hidden):
    """The gaps of a trial share one fit: five of them in two trials are two findings, not five."""
    mask = hidden((20, 22, [0]), (60, 62, [1]), (100, 102, [2]), (140, 142, [0]))
    trials = choice.make_trials(GapQuestion(waves().hide(mask), mask), np.random.default_rng(0))
    assert sum(len(trial.units) for trial in trials[:2]) >= 5
    runners = [Runner("usual"), Runner("slow")]
    for runner, error, n in zip(runners, (1.0, 0.1), (len(trials), 2), strict=True):
        noise = np.random.default_rng(0)
        answers = [t.truth + error * noise.uniform(0.9, 1.1, t.truth.shape) for t in trials[:n]]
        runner.found = dict(enumerate(FilledEntries(answer, None) for answer in answers))
    few = comparison._ranked(trials[:2], runners)
    assert comparison._of_all_gaps(trials[:2], trials)
    assert few.ranking.sharing == ("slow",)
    assert comparison.compared(trials, runners).ranking.order == ("usual",)
