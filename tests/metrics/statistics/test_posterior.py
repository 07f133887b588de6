import math

import baycomp
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy import stats

from mocapbench.metrics.statistics import correlated_t_test

samples = st.lists(st.floats(-10.0, 10.0).map(lambda x: round(x, 3)), min_size=2, max_size=12)
ropes = st.floats(0.001, 5.0)


@given(samples, ropes)
def test_it_agrees_with_baycomp(sample, rope):
    assume(np.ptp(sample) > 0.0)
    zeros = np.zeros(len(sample))
    better, equivalent, worse = baycomp.CorrelatedTTest.probs(np.array(sample), zeros, rope)
    found = correlated_t_test(sample, rope)
    assert found == pytest.approx((better, equivalent, worse), abs=1e-9)


@given(samples, ropes)
def test_probabilities_sum_to_one_and_turn_with_the_sign(sample, rope):
    found, turned = correlated_t_test(sample, rope), correlated_t_test([-x for x in sample], rope)
    assert sum(found) == pytest.approx(1.0)
    assert turned == pytest.approx(found[::-1], abs=1e-12)


@given(samples, ropes, st.floats(0.1, 10.0))
def test_the_unit_of_the_differences_does_not_matter(sample, rope, factor):
    found = correlated_t_test(sample, rope)
    scaled = correlated_t_test([factor * x for x in sample], factor * rope)
    assume(np.ptp(sample) > 0.0)
    assert scaled == pytest.approx(found, abs=1e-9)


@pytest.mark.parametrize(
    ("difference", "expected"),
    [(0.0, (0, 1, 0)), (0.5, (0, 1, 0)), (2.0, (1, 0, 0)), (-2.0, (0, 0, 1))],
)
def test_equal_differences_give_a_probability_of_one(difference, expected):
    assert correlated_t_test([difference] * 3, 1.0) == tuple(expected)


def test_one_unit_gives_nan():
    assert all(math.isnan(p) for p in correlated_t_test([3.0], 1.0))


def test_the_posterior_of_correlated_folds_is_wider():
    sample = [0.5, 0.7, 0.2, 0.9, 0.6]
    better, _, _ = correlated_t_test(sample, 0.0)
    error = np.std(sample, ddof=1) / math.sqrt(5)
    scale = error * math.sqrt(1.0 + 5.0 * 0.25)
    assert better == pytest.approx(stats.t(4, np.mean(sample), scale).sf(0.0))
