import numpy as np
import pytest

from mocapbench.benchmark.filling.attempt import attempt
from mocapbench.benchmark.filling.question import FilledEntries, GapQuestion
from mocapbench.benchmark.filling.trials import choice
from mocapbench.benchmark.filling.trials.scores import held_errors, scores_of, weights_of
from mocapbench.benchmark.registry import MODELS


def test_scores_are_closed_forms(waves, hidden):
    mask = hidden((50, 54, [0, 3]))
    question = GapQuestion(waves().hide(mask), mask)
    trial = choice.make_trials(question, np.random.default_rng(0))[0]
    wanted = trial.question.target
    truth = trial.truth
    off = np.where(np.nonzero(wanted)[1] == 3, 2.0, 1.0)
    answer = FilledEntries(truth + off, np.full(truth.shape, (1.5 / 1.96) ** 2))
    scores = scores_of([trial], [answer], {"deg": 1.0, "cm": 2.0})
    np.testing.assert_allclose(scores.errors, 1.0)
    assert scores.rmse == pytest.approx({"deg": 1.0, "cm": 2.0})
    assert scores.has_bands


def test_each_unit_counts_alike_however_many_channels_have_it(waves, hidden):
    """Three channels in degrees and one in centimetres."""
    mask = hidden((50, 54, [0, 1, 2, 3]))
    trial = choice.make_trials(GapQuestion(waves().hide(mask), mask), np.random.default_rng(0))[0]
    in_cm = np.nonzero(trial.question.target)[1] == 3
    scales = {"deg": 1.0, "cm": 1.0}
    near, far = (
        scores_of([trial], [FilledEntries(trial.truth + off, None)], scales).errors[0]
        for off in (np.where(in_cm, 0.1, 1.2), np.where(in_cm, 1.5, 1.0))
    )
    assert (near, far) == pytest.approx((0.65, 1.25))


def test_scales_are_the_errors_of_the_model_that_holds(waves, hidden):
    mask = hidden((0, 5, [1]), (50, 58, [0, 3]), (120, 150, [3]))
    trials = choice.make_trials(GapQuestion(waves().hide(mask), mask), np.random.default_rng(0))
    answers = [attempt(MODELS.get("hold"), trial.question, 2**45).answer for trial in trials]
    scales = held_errors(trials)
    assert scores_of(trials, answers, scales).rmse == pytest.approx(scales, rel=1e-12)
    assert min(scales.values()) > 0.0


def test_what_does_not_move_has_a_scale_of_one(waves, hidden):
    mask = hidden((50, 58, [0, 3]))
    still = waves().with_values(np.where(np.arange(4) == 3, 90.0, waves().values))
    trials = choice.make_trials(GapQuestion(still.hide(mask), mask), np.random.default_rng(0))
    scales = held_errors(trials)
    assert scales["cm"] == 1.0
    assert scales["deg"] > 1.0


def test_a_unit_without_error_does_not_outweigh_the_others(waves, hidden):
    """Where a body stands still, an interpolation is exact there and may be bad elsewhere."""
    mask = hidden((50, 54, [0, 1, 2, 3]))
    trial = choice.make_trials(GapQuestion(waves().hide(mask), mask), np.random.default_rng(0))[0]
    units = np.nonzero(trial.question.target)[1] == 3
    exact_there, good = (
        scores_of(
            [trial], [FilledEntries(trial.truth + off, None)], {"deg": 1.0, "cm": 1.0}
        ).errors[0]
        for off in (np.where(units, 0.0, 1.0), np.where(units, 1e-6, 0.01))
    )
    assert good < exact_there


def test_errors_of_rounding_are_no_lead(waves, hidden):
    mask = hidden((50, 54, [0]))
    trial = choice.make_trials(GapQuestion(waves().hide(mask), mask), np.random.default_rng(0))[0]
    exact, rounded = (
        scores_of([trial], [FilledEntries(trial.truth + off, None)], {"deg": 1.0, "cm": 1.0}).errors
        for off in (0.0, 1e-13)
    )
    np.testing.assert_array_equal(exact, rounded)


def test_a_gap_counts_by_its_entries_however_many_copies_it_has(waves, hidden):
    mask = hidden((0, 10, [0]), (60, 90, [1, 2]), (150, 155, [3]))
    trials = choice.make_trials(GapQuestion(waves().hide(mask), mask), np.random.default_rng(0))
    weights = weights_of(trials)
    originals = [original for trial in trials for original in trial.originals]
    totals = {e.n_entries: 0.0 for e in originals}
    for weight, original in zip(weights, originals, strict=True):
        totals[original.n_entries] += weight
    assert weights.mean() == pytest.approx(1.0)
    shares = {entries: total / len(weights) for entries, total in totals.items()}
    assert shares == pytest.approx({10: 10 / 75, 60: 60 / 75, 5: 5 / 75})
