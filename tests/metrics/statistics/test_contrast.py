import math
from dataclasses import astuple

import numpy as np
import pandas as pd
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from mocapbench.metrics.statistics import (
    FEWEST_UNITS,
    contrast,
    holm_tests_of_means,
    pair,
    too_few,
    unit_means,
)

NAN = math.nan
values = st.lists(
    st.tuples(*[st.floats(0.1, 10.0).map(lambda x: round(x, 3))] * 2), min_size=1, max_size=8
)


def series(cases):
    rows = {(case, fold): v for case, vs in cases.items() for fold, v in enumerate(vs)}
    return pd.Series(list(rows.values()), index=pd.MultiIndex.from_tuples(rows))


def units(rows, shares=None):
    """Return units of a metric of which lower is better."""
    found = pd.DataFrame(rows, columns=["first", "second"], dtype=float)
    equal = 1.0 / max(len(found), 1)
    share = equal if shares is None else shares
    return found.assign(advantage=found["second"] - found["first"], share=share)


@settings(max_examples=25)
@given(values)
def test_exchanging_the_entrants_reverses_the_contrast(rows):
    there = contrast(units(rows))
    back = contrast(units([(b, a) for a, b in rows]))
    turned = (
        *(there.n, there.second, there.first, -there.advantage, -there.high, -there.low),
        *(there.t_p, there.signed_rank_p, there.worse, there.equivalent, there.better),
    )
    assert astuple(back) == pytest.approx(turned, nan_ok=True, abs=1e-9)


@settings(max_examples=25)
@given(values, st.sampled_from([0.5, 2.0, 1024.0]))
def test_p_values_and_probabilities_do_not_depend_on_the_unit(rows, factor):
    there, scaled = (contrast(units(r)) for r in (rows, factor * np.array(rows)))
    assert astuple(scaled)[6:] == pytest.approx(astuple(there)[6:], nan_ok=True, abs=1e-9)
    assert scaled.advantage == pytest.approx(factor * there.advantage)


@settings(max_examples=25)
@given(values, st.integers(0, 99))
def test_the_order_of_units_does_not_matter(rows, seed):
    there = contrast(units(rows))
    shuffled = contrast(units(np.random.default_rng(seed).permutation(rows)))
    assert astuple(shuffled) == pytest.approx(astuple(there), nan_ok=True, abs=1e-9)


def test_identical_entrants_are_equivalent():
    same = contrast(units([(1.0, 1.0), (2.0, 2.0), (0.5, 0.5), (1.5, 1.5), (3.0, 3.0)]))
    assert (same.advantage, same.t_p, same.signed_rank_p, same.equivalent) == (0.0, 1.0, 1.0, 1.0)


@pytest.mark.parametrize("n", range(1, FEWEST_UNITS + 1))
def test_few_units_have_an_advantage_and_no_test(n):
    few = contrast(units([(1.0, 3.0), (1.0, 2.0), (1.0, 3.5), (2.0, 2.5), (1.0, 4.0)][:n]))
    assert few.n == n
    assert few.advantage > 0.0
    assert all(math.isnan(value) == (n < FEWEST_UNITS) for value in astuple(few)[4:11])


@settings(max_examples=25)
@given(st.lists(st.tuples(*[st.floats(0.1, 10.0)] * 3), min_size=5, max_size=9))
def test_units_weigh_as_much_as_their_share(rows):
    first, second, shares = np.array(rows).T
    shares = shares / shares.sum()
    found = contrast(units(np.column_stack([first, second]), shares))
    means = unit_means([second - first], shares)
    assert found.first == pytest.approx(shares @ first)
    assert found.tested == (not too_few(means.freedom[0]))
    assume(found.tested)
    weighted = holm_tests_of_means(means)
    for name in ("low", "high"):
        assert getattr(found, name) == pytest.approx(*getattr(weighted, name), abs=1e-9)
    assert (found.advantage, found.t_p) == pytest.approx(
        (*weighted["mean"], *weighted["p"]), abs=1e-9
    )


def test_nothing_in_common_is_no_contrast():
    nothing = contrast(units([]))
    assert nothing.n == 0
    assert all(math.isnan(value) for value in astuple(nothing)[1:])


def test_the_region_is_a_share_of_the_mean_value():
    rows = units([(100.0, 101.0)] * 5)
    assert contrast(rows, rope=0.02).equivalent == 1.0
    assert contrast(rows, rope=0.001).better == 1.0
    with pytest.raises(ValueError, match="expected a region"):
        contrast(rows, rope=-0.1)


def test_probabilities_follow_the_shares_and_the_signed_rank_test_does_not():
    rows = [(1.0, 2.0), (1.0, 2.5), (1.0, 1.5), (1.0, 2.0), (5.0, 1.0)]
    equal = contrast(units(rows))
    light, heavy = (
        contrast(units(rows, [(1.0 - last) / 4.0] * 4 + [last])) for last in (0.05, 0.35)
    )
    assert light.better > equal.better > heavy.better
    assert light.signed_rank_p == equal.signed_rank_p == heavy.signed_rank_p
    rows = [(1.0, 1.1)] * 4 + [(100.0, 100.1)]  # the mean value is about 2 or 21
    light, equal = (contrast(units(rows, s), rope=0.04) for s in ([0.2475] * 4 + [0.01], None))
    assert (light.better, equal.equivalent) == (pytest.approx(1.0), pytest.approx(1.0))


def test_only_finite_values_at_common_addresses_are_paired():
    first = series({"x": [1.0, 2.0, NAN, 4.0], "only first": [1.0]})
    second = series({"x": [1.5, NAN, 3.0]})
    pairs = pair(first, second)
    assert pairs.to_dict("list") == {"first": [1.0], "second": [1.5]}
