import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy import stats

from mocapbench.metrics.statistics import ALPHA, UnitMeans, holm, holm_tests, holm_tests_of_means


@st.composite
def families(draw):
    """Return differences of one to eight tests over two to twelve units, some far from zero."""
    shape = draw(st.integers(1, 8)), draw(st.integers(2, 12))
    rng = np.random.default_rng(draw(st.integers(0, 100_000)))
    return rng.normal(size=shape) + rng.choice([0.0, 0.5, 1.0, 3.0], size=(shape[0], 1))


@given(families())
def test_the_tests_are_those_of_scipy_with_holms_correction(differences):
    found = holm_tests(differences)
    p = stats.ttest_1samp(differences, 0.0, axis=1).pvalue
    np.testing.assert_allclose(found.uncorrected_p, p)
    np.testing.assert_allclose(found.p, holm(p))
    np.testing.assert_allclose(found["mean"], differences.mean(axis=1))


@given(families())
def test_an_interval_excludes_zero_exactly_where_the_corrected_p_is_at_most_alpha(differences):
    found = holm_tests(differences)
    assume((np.abs(found.p - ALPHA) > 1e-9).all())
    outside = (found.low > 0.0) | (found.high < 0.0)
    np.testing.assert_array_equal(outside, found.p <= ALPHA)
    np.testing.assert_array_equal(outside, found.separable)


@given(families())
def test_intervals_lie_about_the_mean_and_are_no_narrower_than_that_of_one_test(differences):
    found = holm_tests(differences)
    single = stats.ttest_1samp(differences, 0.0, axis=1).confidence_interval(1.0 - ALPHA)
    np.testing.assert_allclose(found.high - found["mean"], found["mean"] - found.low)
    assert (found.high - found.low >= (single.high - single.low) * (1.0 - 1e-9)).all()


@given(families(), st.randoms(use_true_random=False))
def test_neither_the_order_of_tests_nor_of_units_matters(differences, random):
    tests, units = (random.sample(range(n), n) for n in differences.shape)
    plain, moved = (holm_tests(d) for d in (differences, differences[tests][:, units]))
    for name in ("mean", "low", "high", "p"):
        np.testing.assert_allclose(moved[name], plain[name][tests])


def test_one_test_has_the_plain_interval():
    differences = [1.0, 2.0, 4.0, 1.5]
    low, high = stats.ttest_1samp(differences, 0.0).confidence_interval(0.95)
    found = holm_tests([differences])
    assert (found.low[0], found.high[0]) == pytest.approx((low, high))


def test_a_constant_difference_separates_and_none_does_not():
    found = holm_tests([[0.1] * 3, [0.0] * 3])
    np.testing.assert_array_equal(found.p, [0.0, 1.0])
    np.testing.assert_array_equal(found.low, [0.1, 0.0])
    np.testing.assert_array_equal(found.high, [0.1, 0.0])


def test_a_test_that_cannot_be_made_does_not_count_in_the_family():
    both = UnitMeans(*np.array([[1.0, 9.0], [0.3, np.nan], [5.0, np.nan]]))
    alone = holm_tests_of_means(UnitMeans(both.mean[:1], both.error[:1], both.freedom[:1]))
    beside = holm_tests_of_means(both)
    assert beside.p[0] == alone.p[0]
    assert (beside.low[0], beside.high[0]) == (alone.low[0], alone.high[0])
    assert np.isnan([beside.p[1], beside.low[1], beside.high[1]]).all()
    assert not beside.separable[1]


def test_one_unit_is_no_test():
    assert np.isnan(holm_tests([[3.0]]).p).all()
