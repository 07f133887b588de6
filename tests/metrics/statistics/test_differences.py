import math
from itertools import product

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy import stats

from mocapbench.metrics.statistics import (
    holm,
    least_signed_rank_p,
    mean_interval,
    signed_rank_test,
    t_test,
)

samples = st.lists(st.floats(-1e3, 1e3).map(lambda x: round(x, 3)), min_size=2, max_size=9)
p_lists = st.lists(st.floats(0.0, 1.0), min_size=1, max_size=10)
TESTS = (t_test, signed_rank_test)


distinct = samples.filter(lambda sample: np.ptp(sample) > 0.0)


@given(distinct)
def test_the_t_test_in_closed_form(sample):
    n, error = len(sample), np.std(sample, ddof=1) / math.sqrt(len(sample))
    expected = 2.0 * stats.t.sf(abs(np.mean(sample)) / error, n - 1)
    assert t_test(sample) == pytest.approx(expected, rel=1e-11)


@given(distinct, st.sampled_from([0.5, 0.95, 0.99]))
def test_the_interval_in_closed_form(sample, confidence):
    n, error = len(sample), np.std(sample, ddof=1) / math.sqrt(len(sample))
    half = stats.t.ppf(0.5 + 0.5 * confidence, n - 1) * error
    mean = np.mean(sample)
    low, high = mean_interval(sample, confidence)
    assert low == pytest.approx(mean - half, rel=1e-11, abs=1e-11 * half)
    assert high == pytest.approx(mean + half, rel=1e-11, abs=1e-11 * half)


@given(samples.filter(any))
def test_signed_ranks_in_closed_form(sample):
    """The share of all signs whose sum of ranks is as far from zero."""
    kept = np.array([x for x in sample if x])
    ranks = stats.rankdata(np.abs(kept))
    sums = np.array(list(product((-1.0, 1.0), repeat=len(kept)))) @ ranks
    share = np.mean(np.abs(sums) >= abs(np.sign(kept) @ ranks))
    assert signed_rank_test(sample) == pytest.approx(share, rel=1e-12)


def test_differences_that_are_equal_but_for_rounding_give_no_warning(recwarn):
    sample = [0.1, np.nextafter(0.1, 1.0), 0.1]
    assert t_test(sample) == pytest.approx(0.0, abs=1e-12)
    assert mean_interval(sample) == pytest.approx((0.1, 0.1))
    assert not recwarn.list


@pytest.mark.parametrize("test", TESTS)
@given(sample=samples, factor=st.floats(0.01, 100.0), seed=st.integers(0, 99))
def test_no_test_depends_on_sign_scale_or_order(test, sample, factor, seed):
    expected = test(sample)
    shuffled = np.random.default_rng(seed).permutation(sample)
    assert test([-x for x in sample]) == pytest.approx(expected)
    assert test(shuffled) == pytest.approx(expected)
    if test is t_test:
        assert test([factor * x for x in sample]) == pytest.approx(expected, rel=1e-6)


@given(samples)
def test_the_interval_of_the_opposite_is_the_opposite(sample):
    low, high = mean_interval(sample)
    assert mean_interval([-x for x in sample]) == pytest.approx((-high, -low))


@given(samples)
def test_the_interval_holds_zero_exactly_when_the_test_does_not_reject(sample):
    low, high = mean_interval(sample)
    p = t_test(sample)
    assume(abs(p - 0.05) > 1e-9)
    assert (low <= 0.0 <= high) == (p > 0.05)


@pytest.mark.parametrize("test", TESTS)
def test_p_is_one_without_differences_and_nan_for_one_unit(test):
    assert test([0.0, 0.0, 0.0]) == 1.0
    assert math.isnan(test([0.3]))


def test_equal_differences_have_p_zero_and_an_interval_without_width():
    assert t_test([0.1, 0.1, 0.1]) == 0.0
    assert mean_interval([0.1, 0.1, 0.1]) == pytest.approx((0.1, 0.1), rel=1e-12)
    assert all(math.isnan(end) for end in mean_interval([0.1]))


@pytest.mark.parametrize("n", range(2, 13))
def test_signed_ranks_cannot_go_below_their_least_p(n):
    tied, distinct = [1.0] * n, list(range(1, n + 1))
    assert signed_rank_test(tied) == pytest.approx(least_signed_rank_p(n))
    assert signed_rank_test(distinct) == pytest.approx(least_signed_rank_p(n))


def test_five_units_cannot_reject_by_signed_ranks():
    assert least_signed_rank_p(5) == 0.0625


@pytest.mark.parametrize("sample", [[3.0, -1.0, 2.0], [1.0, 1.0, -1.0, 0.0, 2.0], [0.0, 5.0]])
def test_signed_ranks_are_those_of_wilcoxon_in_scipy(sample):
    every_sign = stats.PermutationMethod(n_resamples=2 ** len(sample))
    assert signed_rank_test(sample) == pytest.approx(
        stats.wilcoxon(sample, method=every_sign).pvalue, rel=1e-12
    )


@pytest.mark.parametrize("n", [13, 30])
def test_many_units_without_ties_are_those_of_scipy_s_exact_test(n):
    sample = np.random.default_rng(n).normal(0.3, 1.0, n)
    expected = stats.wilcoxon(sample, method="exact").pvalue
    assert signed_rank_test(sample) == pytest.approx(expected, rel=1e-9)


@given(samples.filter(any), st.integers(0, 40))
def test_units_that_do_not_differ_change_no_p(sample, n_zeros):
    assert signed_rank_test([*sample, *[0.0] * n_zeros]) == signed_rank_test(sample)


def test_many_units_agree_with_the_normal_approximation():
    sample = np.random.default_rng(0).normal(0.3, 1.0, 101)
    expected = stats.wilcoxon(sample, method="approx").pvalue
    assert signed_rank_test(sample) == pytest.approx(expected, rel=1e-12)
    assert signed_rank_test(sample[:100]) == pytest.approx(
        stats.wilcoxon(sample[:100], method="approx").pvalue, abs=0.001
    )


@pytest.mark.parametrize("bad", [[], [math.nan, 1.0], [math.inf], [[1.0, 2.0]]])
def test_malformed_samples_are_refused(bad):
    with pytest.raises(ValueError, match="finite differences"):
        t_test(bad)


def test_holm_in_closed_form():
    assert holm([0.01, 0.04, 0.03, 0.005]) == pytest.approx([0.03, 0.06, 0.06, 0.02])


@given(p_lists, st.integers(0, 99))
def test_holm_keeps_order_raises_every_p_and_ignores_arrangement(p_values, seed):
    adjusted, p = holm(p_values), np.array(p_values)
    assert (adjusted >= p).all()
    assert (adjusted <= np.minimum(len(p) * p, 1.0) + 1e-12).all()  # never above Bonferroni's
    assert (np.diff(adjusted[np.argsort(p)]) >= 0.0).all()
    order = np.random.default_rng(seed).permutation(len(p))
    np.testing.assert_allclose(holm(p[order]), adjusted[order])


def test_a_test_that_was_not_made_does_not_count_in_the_family():
    np.testing.assert_allclose(holm([0.02, math.nan, 0.03]), [0.04, math.nan, 0.04])
    assert holm([]).size == 0
