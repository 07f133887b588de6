import numpy as np
import pytest

from mocapbench.benchmark.filling.choosing import choice
from mocapbench.benchmark.filling.choosing.scores import (
    score_gaps,
    score_holding,
    score_units,
    weigh_gaps,
)
from mocapbench.benchmark.filling.fill_attempt import attempt_fill
from mocapbench.benchmark.filling.gap_problem import GapProblem, PredictedEntries
from mocapbench.benchmark.registry import MODELS


def test_scores_are_closed_forms(held_out, waves, hidden):
    mask = hidden((50, 54, [0, 3]))
    hold_out = held_out(mask)[0]
    wanted = hold_out.problem.target
    truth = hold_out.truth
    off = np.where(np.nonzero(wanted)[1] == 3, 2.0, 1.0)
    prediction = PredictedEntries(truth + off, np.full(truth.shape, (1.5 / 1.96) ** 2))
    errors = score_gaps([hold_out], [prediction], {"deg": 1.0, "cm": 2.0})
    np.testing.assert_allclose(errors, 1.0)
    assert score_units([hold_out], [prediction]) == pytest.approx({"deg": 1.0, "cm": 2.0})


def test_each_unit_counts_alike_however_many_channels_have_it(waves, hidden):
    """Three channels in degrees and one in centimetres."""
    mask = hidden((50, 54, [0, 1, 2, 3]))
    hold_out = choice.make_hold_outs(
        GapProblem(waves().hide(mask), mask), np.random.default_rng(0)
    )[0]
    in_cm = np.nonzero(hold_out.problem.target)[1] == 3
    scales = {"deg": 1.0, "cm": 1.0}
    near, far = (
        score_gaps([hold_out], [PredictedEntries(hold_out.truth + off, None)], scales)[0]
        for off in (np.where(in_cm, 0.1, 1.2), np.where(in_cm, 1.5, 1.0))
    )
    assert (near, far) == pytest.approx((0.65, 1.25))


def test_scales_are_the_errors_of_the_model_that_holds(waves, hidden):
    mask = hidden((0, 5, [1]), (50, 58, [0, 3]), (120, 150, [3]))
    hold_outs = choice.make_hold_outs(
        GapProblem(waves().hide(mask), mask), np.random.default_rng(0)
    )
    predictions = [
        attempt_fill(MODELS.get("hold"), hold_out.problem, 2**45).prediction
        for hold_out in hold_outs
    ]
    scales = score_holding(hold_outs)
    assert score_units(hold_outs, predictions) == pytest.approx(scales, rel=1e-12)
    assert min(scales.values()) > 0.0


def test_what_does_not_move_has_a_scale_of_one(held_out, waves, hidden):
    mask = hidden((50, 58, [0, 3]))
    still = waves().with_values(np.where(np.arange(4) == 3, 90.0, waves().values))
    hold_outs = held_out(mask, still)
    scales = score_holding(hold_outs)
    assert scales["cm"] == 1.0
    assert scales["deg"] > 1.0


def test_a_unit_without_error_does_not_outweigh_the_others(waves, hidden):
    """Where a body stands still, an interpolation is exact there and may be bad elsewhere."""
    mask = hidden((50, 54, [0, 1, 2, 3]))
    hold_out = choice.make_hold_outs(
        GapProblem(waves().hide(mask), mask), np.random.default_rng(0)
    )[0]
    units = np.nonzero(hold_out.problem.target)[1] == 3
    exact_there, good = (
        score_gaps(
            [hold_out], [PredictedEntries(hold_out.truth + off, None)], {"deg": 1.0, "cm": 1.0}
        )[0]
        for off in (np.where(units, 0.0, 1.0), np.where(units, 1e-6, 0.01))
    )
    assert good < exact_there


def test_errors_of_rounding_are_no_lead(waves, hidden):
    mask = hidden((50, 54, [0]))
    hold_out = choice.make_hold_outs(
        GapProblem(waves().hide(mask), mask), np.random.default_rng(0)
    )[0]
    exact, rounded = (
        score_gaps(
            [hold_out], [PredictedEntries(hold_out.truth + off, None)], {"deg": 1.0, "cm": 1.0}
        )
        for off in (0.0, 1e-13)
    )
    np.testing.assert_array_equal(exact, rounded)


def test_a_gap_counts_by_its_entries_however_many_copies_it_has(waves, hidden):
    mask = hidden((5, 15, [0]), (60, 90, [1, 2]), (150, 155, [3]))
    hold_outs = choice.make_hold_outs(
        GapProblem(waves().hide(mask), mask), np.random.default_rng(0)
    )
    weights = weigh_gaps(hold_outs)
    originals = [original for hold_out in hold_outs for original in hold_out.originals]
    totals = {e.n_entries: 0.0 for e in originals}
    for weight, original in zip(weights, originals, strict=True):
        totals[original.n_entries] += weight
    assert weights.mean() == pytest.approx(1.0)
    shares = {entries: total / len(weights) for entries, total in totals.items()}
    assert shares == pytest.approx({10: 10 / 75, 60: 60 / 75, 5: 5 / 75})
