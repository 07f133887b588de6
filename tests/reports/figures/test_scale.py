"""Scales map ends to ends, are monotone, and have ticks at round values within them."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.reports.figures.axes import format_tick
from mocapbench.reports.figures.scale import (
    LinearScale,
    LogScale,
    fit_count_scale,
    fit_scale,
    remark,
)

NUMBERS = st.floats(-1e6, 1e6, allow_nan=False).map(lambda x: round(x, 6))
POSITIVE = st.floats(1e-6, 1e6)


@pytest.fixture(params=[LinearScale, LogScale])
def kind(request):
    return request.param


@given(low=POSITIVE, ratio=st.floats(1.01, 1e9), shares=st.lists(st.floats(0, 1), min_size=2))
@pytest.mark.parametrize("scale_type", [LinearScale, LogScale])
def test_a_scale_maps_ends_to_ends_and_is_monotone(scale_type, low, ratio, shares):
    scale = scale_type(low, low * ratio, 300.0, 20.0)
    assert scale.place(scale.low) == pytest.approx(300.0)
    assert scale.place(scale.high) == pytest.approx(20.0)
    values = low + np.sort(shares) * (low * ratio - low)
    assert (np.diff(scale.places(values)) <= 1e-9).all()


@given(low=POSITIVE, ratio=st.floats(1.01, 1e9))
@pytest.mark.parametrize("scale_type", [LinearScale, LogScale])
def test_ticks_are_few_ascending_round_and_within_the_ends(scale_type, low, ratio):
    scale = scale_type(low, low * ratio, 0.0, 100.0)
    ticks = scale.ticks(5)
    assert 1 <= len(ticks) <= 12
    assert ticks == sorted(set(ticks))
    assert all(scale.low - 1e-9 * low <= tick <= scale.high * (1 + 1e-9) for tick in ticks)
    assert len({format_tick(tick) for tick in ticks}) == len(ticks) or ratio < 1.02


@given(values=st.lists(NUMBERS, min_size=1))
def test_the_fitted_scale_shows_every_value(values):
    scale = fit_scale([*values, math.nan], 10.0, 90.0)
    places = scale.places(np.array(values))
    assert ((places > 10.0) & (places < 90.0)).all()


def test_values_over_more_than_a_factor_ten_take_a_logarithmic_scale():
    assert isinstance(fit_scale([1.0, 11.0], 0.0, 1.0), LogScale)
    assert isinstance(fit_scale([1.0, 9.0], 0.0, 1.0), LinearScale)
    assert isinstance(fit_scale([-1.0, 100.0], 0.0, 1.0), LinearScale)


def test_an_axis_that_spans_little_says_so():
    assert "spans 1 %" in remark(LinearScale(99.0, 100.0, 0.0, 1.0))
    assert remark(LinearScale(50.0, 100.0, 0.0, 1.0)) == ""


@pytest.mark.parametrize(
    ("tick", "text"),
    [(0.0, "0"), (-1.5, "−1.5"), (0.0002, "2·10⁻⁴"), (1e6, "10⁶"), (2500.0, "2500")],
)
def test_ticks_are_written_for_people(tick, text):
    assert format_tick(tick) == text


def test_counts_begin_at_zero_and_equal_ratios_take_about_equal_lengths():
    scale = fit_count_scale([0, 3, 10, 30, 100], 0.0, 100.0)
    places = scale.places(np.array([0.0, 3.0, 10.0, 30.0, 100.0]))
    assert 0 < places[0] < places[-1] < 100
    steps = np.diff(places)
    assert steps.max() < 1.5 * steps.min()
    assert scale.ticks() == [0, 1, 3, 10, 30, 100]
    np.testing.assert_allclose(scale.backward(scale.forward(places)), places)


def test_ticks_of_many_counts_are_few_and_zero_is_among_them():
    ticks = fit_count_scale([0, 50_000], 0.0, 100.0).ticks(4)
    assert ticks == [0, 1000, 3000, 10_000, 30_000]


@pytest.mark.parametrize("values", [(1e-320, 1.0), (1.0, 1e308), (-1e308, 1e308), (5e-324, 1e308)])
def test_the_largest_and_smallest_numbers_have_an_axis(values):
    scale = fit_scale(values, 0.0, 100.0)
    assert np.isfinite([scale.low, scale.high, *scale.ticks()]).all()
    assert np.isfinite(scale.place(1.0))
