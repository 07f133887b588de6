import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy import stats

from mocapbench.reports.analysis.interval import half_widths
from mocapbench.reports.figures.fitting import fitted
from mocapbench.reports.figures.intervals import centre, interval
from mocapbench.reports.figures.scale import LogScale

positive = st.lists(st.floats(0.01, 1e3), min_size=2, max_size=12)


def log_interval(values):
    scale = LogScale(1e-3, 1e5, 0.0, 100.0)
    return (centre(values, scale), *interval(values, scale))


@given(positive)
def test_half_widths_are_those_of_students_t_whatever_is_missing(values):
    assume(np.std(values) > 1e-6)
    expected = stats.ttest_1samp(values, 0.0).confidence_interval(0.95)
    half = 0.5 * (expected.high - expected.low)
    assert half_widths(values) == pytest.approx(half)
    assert half_widths([*values, np.nan]) == pytest.approx(half)


@given(positive, st.floats(0.1, 10.0))
def test_a_log_interval_moves_with_the_unit_and_stays_above_zero(values, factor):
    plain, scaled = log_interval(values), log_interval([factor * value for value in values])
    assert scaled == pytest.approx([factor * bound for bound in plain])
    middle, low, high = plain
    assert 0.0 <= low <= middle <= high
    assert middle == pytest.approx(stats.gmean(values))


@given(positive)
def test_a_log_interval_is_symmetric_on_a_logarithmic_axis(values):
    middle, low, high = log_interval(values)
    assume(low > 0.0 and np.isfinite(high))
    assert np.log(high / middle) == pytest.approx(np.log(middle / low), abs=1e-9)


@pytest.mark.parametrize("values", [[1.0, 0.0], [1.0, -2.0], []])
def test_values_that_are_not_above_zero_get_no_logarithmic_scale(values):
    assert not isinstance(fitted(values, 0.0, 100.0), LogScale)


@pytest.mark.parametrize("values", [[1.0], []])
def test_too_few_values_have_no_interval(values):
    assert interval(values, LogScale(1e-3, 1e5, 0.0, 100.0)) is None


def test_one_value_has_no_interval():
    assert np.isnan(half_widths([3.0]))
