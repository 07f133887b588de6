import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import linalg, stats

from mocapbench.metrics.statistics import FEWEST_UNITS, mean_interval, t_test, too_few, unit_means

counts = st.lists(st.integers(1, 9), min_size=2, max_size=8)
seeds = st.integers(0, 9_999)
laws = settings(max_examples=30)


def shares_of(recordings):
    return np.array(recordings) / sum(recordings)


def values_of(recordings, seed):
    return np.random.default_rng(seed).normal(0.3, 1.0, len(recordings))


def bell_mccaffrey(recordings, cells):
    """Return the CR2 variance of a mean of cells and its degrees of freedom, by dense algebra."""
    n_cells = sum(recordings)
    hat = np.full((n_cells, n_cells), 1.0 / n_cells)
    residuals_of = np.eye(n_cells) - hat
    ends = np.cumsum(recordings)
    columns = []
    for first, end in zip(ends - recordings, ends, strict=True):
        adjusted = linalg.fractional_matrix_power(residuals_of[first:end, first:end], -0.5)
        columns.append(residuals_of[:, first:end] @ adjusted @ np.full(end - first, 1.0 / n_cells))
    columns = np.array(columns)
    eigenvalues = np.linalg.eigvalsh(columns @ columns.T)
    return np.sum((columns @ cells) ** 2), eigenvalues.sum() ** 2 / np.sum(eigenvalues**2)


@laws
@given(counts, seeds)
def test_error_and_freedom_are_those_of_bell_and_mccaffrey(recordings, seed):
    values = values_of(recordings, seed)
    found = unit_means(values, shares_of(recordings))
    variance, freedom = bell_mccaffrey(recordings, np.repeat(values, recordings))
    assert found.mean == pytest.approx(np.repeat(values, recordings).mean())
    assert found.error**2 == pytest.approx(variance)
    assert found.freedom == pytest.approx(freedom)


@laws
@given(st.integers(2, 12), seeds)
def test_units_of_equal_shares_have_the_ordinary_t_test(n, seed):
    values = values_of([1] * n, seed)
    found, ordinary = unit_means(values, np.full(n, 1.0 / n)), stats.ttest_1samp(values, 0.0)
    assert found.freedom == pytest.approx(n - 1, rel=1e-12)
    assert found.p == pytest.approx(ordinary.pvalue, rel=1e-11)
    assert found.mean - found.half_widths(0.1) == pytest.approx(
        ordinary.confidence_interval(0.9).low
    )


@laws
@given(counts)
def test_no_shares_are_worth_more_than_equal_ones(recordings):
    n, freedom = (
        len(recordings),
        unit_means(np.arange(len(recordings)), shares_of(recordings)).freedom,
    )
    assert 1.0 - 1e-9 <= freedom <= n - 1 + 1e-9
    assert (freedom == pytest.approx(n - 1)) == (len(set(recordings)) == 1 or n == 2)


@laws
@given(counts, seeds, st.randoms(use_true_random=False))
def test_neither_order_nor_units_of_no_share_matter(recordings, seed, random):
    values, shares = values_of(recordings, seed), shares_of(recordings)
    order = random.sample(range(len(values)), len(values))
    found = unit_means(values, shares)
    for other in (
        unit_means(values[order], shares[order]),
        unit_means([*values, np.nan, 7.0], [*shares, 0.0, 0.0]),
    ):
        for name in ("mean", "error", "freedom", "p"):
            assert getattr(other, name) == pytest.approx(getattr(found, name), nan_ok=True)


@laws
@given(counts, seeds)
def test_the_interval_and_the_test_say_the_same_of_unequal_shares(recordings, seed):
    values, shares = values_of(recordings, seed), shares_of(recordings)
    p = t_test(values, shares)
    low, high = mean_interval(values, 1.0 - p, shares)
    assert min(abs(low), abs(high)) == pytest.approx(0.0, abs=1e-7)


@pytest.mark.parametrize("n", range(1, FEWEST_UNITS + 3))
def test_units_of_equal_shares_are_too_few_below_five(n):
    freedom = unit_means(np.arange(n), np.full(n, 1.0 / n)).freedom
    assert too_few(freedom) == (n < FEWEST_UNITS)


@pytest.mark.parametrize(
    ("recordings", "few"),
    [((1, 2, 1, 2, 2), False), ((10, 1, 1, 1, 1), True), ((31, 2, 2, 2, 2, 2, 2), True)],
)
def test_units_are_too_few_where_few_of_them_weigh_most(recordings, few):
    found = unit_means(np.arange(len(recordings)), shares_of(recordings))
    assert too_few(found.freedom) == few
    assert np.isnan(found.drop_errors_of_few_units().p) == few
    assert found.drop_errors_of_few_units().mean == found.mean


def test_a_single_unit_has_a_mean_and_no_error():
    found = unit_means([[3.0], [4.0]], [1.0])
    assert found.mean.tolist() == [3.0, 4.0]
    assert np.isnan([found.error, found.freedom, found.p]).all()
