import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from mocapbench.metrics.statistics import friedman, group_ranks, mean_ranks, nemenyi

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
    ranks = mean_ranks(table)
    assert friedman(table) == pytest.approx(stats.friedmanchisquare(*table.T).pvalue)
    assert (mean_ranks(np.exp(table)), friedman(np.exp(table))) == (ranks, friedman(table))
    assert sum(ranks) == pytest.approx(10.0)
    order = [2, 0, 3, 1]
    assert mean_ranks(table[:, order]) == tuple(ranks[i] for i in order)


@settings(max_examples=30)
@given(tables)
def test_groups_hold_exactly_the_pairs_within_the_critical_difference(table):
    losses = table + 2.0 * np.arange(4)
    ranks, difference, p_value = mean_ranks(losses), nemenyi(*losses.shape), friedman(losses)
    groups = group_ranks(ranks, difference, p_value)
    together = {frozenset((i, j)) for group in groups for i in group for j in group if i != j}
    close = {
        frozenset((i, j))
        for i in range(4)
        for j in range(i)
        if abs(ranks[i] - ranks[j]) <= difference or p_value > 0.05
    }
    assert together == close


def test_no_group_is_part_of_another():
    groups = group_ranks((1.0, 2.0, 3.0, 4.5), difference=1.0, p_value=0.01)
    assert groups == ((0, 1), (1, 2))


def test_without_an_overall_difference_all_are_one_group():
    assert group_ranks((1.0, 2.0, 3.0), 0.5, p_value=0.2) == ((0, 1, 2),)


def test_identical_entrants_tie():
    ties = np.ones((3, 4))
    assert mean_ranks(ties) == (2.5,) * 4
    assert friedman(ties) == 1.0
    assert group_ranks(mean_ranks(ties), nemenyi(3, 4), 1.0) == ((0, 1, 2, 3),)


@pytest.mark.parametrize("shape", [(1, 3), (4, 2), (0, 0)])
def test_too_little_to_rank_is_refused(shape):
    with pytest.raises(ValueError, match="expected 2 or more blocks"):
        mean_ranks(np.zeros(shape))


def test_missing_values_are_refused():
    with pytest.raises(ValueError, match="got NaN"):
        friedman([[1.0, 2.0, NAN]] * 2)
