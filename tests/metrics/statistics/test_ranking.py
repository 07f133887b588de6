import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from mocapbench.metrics.statistics import RankComparison, compare_ranks, nemenyi

NAN = math.nan
tables = st.integers(0, 10_000).map(lambda seed: np.random.default_rng(seed).normal(size=(6, 4)))


# Table 5a of Demšar (2006): q at 5 % for 2 to 10 classifiers.
@pytest.mark.parametrize(
    ("k", "quantile"),
    list(enumerate((1.960, 2.343, 2.569, 2.728, 2.850, 2.949, 3.031, 3.102, 3.164), start=2)),
)
def test_the_critical_difference_is_the_printed_one(k, quantile):
    assert nemenyi(9, k) == pytest.approx(quantile * math.sqrt(k * (k + 1) / 54), rel=2e-3)


def test_demsars_example():
    # §3.2.3: four classifiers on 14 data sets have a critical difference of 1.25.
    assert nemenyi(14, 4) == pytest.approx(1.25, abs=0.01)


@settings(max_examples=30)
@given(tables)
def test_friedman_is_that_of_scipy_and_ranks_are_invariant(table):
    found = compare_ranks(table)
    assert found.p_value == pytest.approx(stats.friedmanchisquare(*table.T).pvalue)
    assert compare_ranks(np.exp(table)) == found
    assert sum(found.mean_ranks) == pytest.approx(10.0)
    order = [2, 0, 3, 1]
    assert compare_ranks(table[:, order]).mean_ranks == tuple(found.mean_ranks[i] for i in order)


@settings(max_examples=30)
@given(tables)
def test_groups_hold_exactly_the_pairs_within_the_critical_difference(table):
    found = compare_ranks(table + 2.0 * np.arange(4))
    together = {frozenset((i, j)) for group in found.groups for i in group for j in group if i != j}
    ranks = found.mean_ranks
    close = {
        frozenset((i, j))
        for i in range(4)
        for j in range(i)
        if abs(ranks[i] - ranks[j]) <= found.difference or found.p_value > 0.05
    }
    assert together == close


def test_no_group_is_part_of_another():
    ranks = RankComparison((1.0, 2.0, 3.0, 4.5), difference=1.0, p_value=0.01, n=9)
    assert ranks.groups == ((0, 1), (1, 2))


def test_without_an_overall_difference_all_are_one_group():
    assert RankComparison((1.0, 2.0, 3.0), 0.5, p_value=0.2, n=3).groups == ((0, 1, 2),)


def test_identical_entrants_tie():
    found = compare_ranks(np.ones((3, 4)))
    assert found.mean_ranks == (2.5,) * 4
    assert (found.p_value, found.groups) == (1.0, ((0, 1, 2, 3),))


@pytest.mark.parametrize("shape", [(1, 3), (4, 2), (0, 0)])
def test_too_little_to_rank_is_refused(shape):
    with pytest.raises(ValueError, match="expected 2 or more blocks"):
        compare_ranks(np.zeros(shape))


def test_missing_values_are_refused():
    with pytest.raises(ValueError, match="got NaN"):
        compare_ranks([[1.0, 2.0, NAN]] * 2)
