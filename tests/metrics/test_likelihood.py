import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import norm

from mocapbench.metrics import msll

seeds = st.integers(0, 2**32 - 1)


def test_one_entry_by_hand(make):
    outcome = make([[3.0]], 2.0, 4.0, visible_mean=[0.0], visible_variance=[1.0])
    # ½ log 4 + 1/8 against 9/2; the halves of log 2π cancel
    assert msll(outcome).value == pytest.approx(np.log(2.0) + 0.125 - 4.5)


@given(seed=seeds)
def test_the_trivial_gaussian_scores_zero(draw, seed):
    outcome = draw(seed)
    shape = outcome.truth.shape
    trivial = dataclasses.replace(
        outcome,
        mean=np.broadcast_to(outcome.visible_mean, shape),
        variance=np.broadcast_to(outcome.visible_variance, shape),
    )
    assert msll(trivial).value == pytest.approx(0.0, abs=1e-12)


@given(seed=seeds)
def test_it_is_the_mean_difference_of_gaussian_log_densities(draw, seed):
    outcome = draw(seed)
    sd = np.sqrt(np.where(outcome.hidden, outcome.variance, 1.0))
    predicted = norm.logpdf(outcome.truth, outcome.mean, sd)
    trivial = norm.logpdf(outcome.truth, outcome.visible_mean, np.sqrt(outcome.visible_variance))
    assert msll(outcome).value == pytest.approx((trivial - predicted)[outcome.hidden].mean())


@given(
    seed=seeds,
    scale=st.lists(st.floats(0.1, 100), min_size=4, max_size=4),
    offset=st.lists(st.floats(-10, 10), min_size=4, max_size=4),
)
def test_it_is_invariant_to_the_unit_of_an_output(draw, seed, scale, offset):
    outcome = draw(seed)
    rescaled = dataclasses.replace(
        outcome,
        truth=outcome.truth * scale + offset,
        mean=outcome.mean * scale + offset,
        variance=outcome.variance * np.square(scale),
        visible_mean=outcome.visible_mean * scale + offset,
        visible_variance=outcome.visible_variance * np.square(scale),
    )
    assert msll(rescaled).value == pytest.approx(msll(outcome).value, rel=1e-9, abs=1e-9)


def test_an_output_that_never_varies_is_left_out_and_counted(make):
    outcome = make([[1.0, 5.0]], 0.0, 1.0, visible_variance=[1.0, 1e-13])
    alone = make([[1.0]], 0.0, 1.0)
    assert msll(outcome).value == msll(alone).value
    assert msll(outcome).left_out == 1
    assert np.isnan(msll(outcome).parts["output"][1])
