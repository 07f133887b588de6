import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.metrics import mae, mse, rms_per_frame, smse, smse_pooled

seeds = st.integers(0, 2**32 - 1)


def test_two_frames_of_two_outputs_by_hand(make):
    outcome = make([[1.0, 2.0], [3.0, 6.0]], [[1.0, 4.0], [2.0, 5.0]])
    # squared errors [[0, 4], [1, 1]]; variances of the truth 1 and 4, pooled 3.5
    assert mse(outcome).value == 1.5
    np.testing.assert_array_equal(mse(outcome).parts["output"], [0.5, 2.5])
    np.testing.assert_array_equal(mse(outcome).parts["frame"], [2.0, 1.0])
    assert mae(outcome).value == 1.0
    np.testing.assert_array_equal(mae(outcome).parts["output"], [0.5, 1.5])
    np.testing.assert_allclose(smse(outcome).parts["output"], [0.5, 0.625])
    assert smse(outcome).value == pytest.approx(0.5625)
    assert smse_pooled(outcome).value == pytest.approx(1.5 / 3.5)
    np.testing.assert_allclose(rms_per_frame(outcome).parts["frame"], [2.0, np.sqrt(2.0)])
    assert rms_per_frame(outcome).value == pytest.approx((2.0 + np.sqrt(2.0)) / 2)


def test_only_hidden_entries_and_frames_are_averaged(make):
    outcome = make(
        [[1.0, 5.0], [0.0, 0.0], [3.0, 9.0]],
        [[0.0, 0.0], [7.0, 7.0], [0.0, 0.0]],
        hidden=np.array([[True, False], [False, False], [True, False]]),
    )
    assert mse(outcome).value == 5.0
    assert mae(outcome).value == 2.0
    np.testing.assert_array_equal(mse(outcome).parts["output"], [5.0, np.nan])
    np.testing.assert_array_equal(rms_per_frame(outcome).parts["frame"], [1.0, np.nan, 3.0])
    assert rms_per_frame(outcome).value == 2.0
    assert smse(outcome).left_out == smse_pooled(outcome).left_out == 0


@given(seed=seeds, shift=st.floats(-1e3, 1e3))
def test_a_constant_shift_costs_its_square(draw, seed, shift):
    outcome = draw(seed)
    shifted = dataclasses.replace(outcome, mean=outcome.truth + shift)
    assert mse(shifted).value == pytest.approx(shift**2, rel=1e-9)


@given(seed=seeds)
def test_the_hidden_mean_has_standardised_error_one(draw, seed):
    outcome = draw(seed)
    hidden_only = np.where(outcome.hidden, outcome.truth, np.nan)
    own = dataclasses.replace(
        outcome, mean=np.broadcast_to(np.nanmean(hidden_only, axis=0), outcome.truth.shape)
    )
    pooled = dataclasses.replace(
        outcome, mean=np.full(outcome.truth.shape, np.nanmean(hidden_only))
    )
    np.testing.assert_allclose(smse(own).parts["output"], 1.0)
    assert smse_pooled(pooled).value == pytest.approx(1.0)


@given(seed=seeds, order=st.permutations(range(4)))
def test_the_order_of_outputs_does_not_matter(draw, seed, order):
    outcome = draw(seed)
    permuted = dataclasses.replace(
        outcome,
        truth=outcome.truth[:, order],
        mean=outcome.mean[:, order],
        variance=None,
        hidden=outcome.hidden[:, order],
        visible_variance=outcome.visible_variance[list(order)],
    )
    for metric in (mse, smse, smse_pooled, rms_per_frame):
        assert metric(permuted).value == pytest.approx(metric(outcome).value)


@given(
    seed=seeds,
    scale=st.lists(st.floats(0.1, 100), min_size=4, max_size=4),
    offset=st.lists(st.floats(-10, 10), min_size=4, max_size=4),
)
def test_smse_is_invariant_to_the_unit_of_an_output(draw, seed, scale, offset):
    outcome = draw(seed)
    rescaled = dataclasses.replace(
        outcome, truth=outcome.truth * scale + offset, mean=outcome.mean * scale + offset
    )
    assert smse(rescaled).value == pytest.approx(smse(outcome).value)


@given(seed=seeds, scale=st.floats(0.1, 100), offset=st.floats(-10, 10))
def test_pooled_smse_is_invariant_to_a_common_unit(draw, seed, scale, offset):
    outcome = draw(seed)
    rescaled = dataclasses.replace(
        outcome, truth=outcome.truth * scale + offset, mean=outcome.mean * scale + offset
    )
    assert smse_pooled(rescaled).value == pytest.approx(smse_pooled(outcome).value)


@given(seed=seeds)
def test_aggregates_are_means_of_their_parts(draw, seed):
    outcome = draw(seed)
    assert smse(outcome).value == pytest.approx(smse(outcome).parts["output"].mean())
    assert rms_per_frame(outcome).value == pytest.approx(
        np.nanmean(rms_per_frame(outcome).parts["frame"])
    )
    whole = dataclasses.replace(outcome, variance=None, hidden=np.ones_like(outcome.hidden))
    for metric in (mse, smse_pooled):
        assert metric(whole).value == pytest.approx(metric(whole).parts["output"].mean())


def test_degenerate_outputs_are_left_out_and_counted(make):
    outcome = make(
        [[1.0, 2.0, 5.0], [3.0, 4.0, 5.0]],
        [[2.0, 9.0, 6.0], [2.0, 9.0, 6.0]],
        visible_variance=[1.0, 1e-13, 1.0],
    )
    # the second is constant where visible, the third where hidden
    assert smse(outcome).left_out == 2
    np.testing.assert_array_equal(smse(outcome).parts["output"], [1.0, np.nan, np.nan])
    assert smse_pooled(outcome).left_out == 1
    assert smse_pooled(outcome).value == pytest.approx(1.0 / np.var([1.0, 3.0, 5.0, 5.0]))


def test_nothing_left_is_not_a_number(make):
    outcome = make([[1.0], [3.0]], 0.0, visible_variance=[0.0])
    assert np.isnan(smse(outcome).value)
    assert np.isnan(smse_pooled(outcome).value)
