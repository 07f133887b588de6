import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from samples import draws
from scipy import stats

from mocapbench.metrics.statistics import mean_interval
from mocapbench.reports.analysis.units import FoldSample
from mocapbench.reports.figures.intervals import centre, interval
from mocapbench.reports.figures.scale import LinearScale, LogScale, fit_scale

positive = st.lists(st.floats(0.01, 1e3), min_size=2, max_size=12)


def log_interval(values):
    scale = LogScale(1e-3, 1e5, 0.0, 100.0)
    return (centre(draws(values), scale), *interval(draws(values), scale))


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
    assert not isinstance(fit_scale(values, 0.0, 100.0), LogScale)


@given(positive, st.lists(st.sampled_from("abc"), min_size=12, max_size=12))
def test_an_interval_is_of_the_mean_over_folds_with_the_error_of_units(values, people):
    names = people[: len(values)]
    sample = FoldSample.of(values, names, ["walk"] * len(values))
    scale = LinearScale(-1e4, 1e4, 0.0, 100.0)
    assert centre(sample, scale) == pytest.approx(np.mean(values))
    of_units = {name: np.compress(np.array(names) == name, values) for name in set(names)}
    assume(len(of_units) > 1)
    shares = [len(folds) / len(values) for folds in of_units.values()]
    expected = mean_interval([folds.mean() for folds in of_units.values()], shares=shares)
    assert interval(sample, scale) == pytest.approx(expected)


@given(values=st.lists(st.floats(0.01, 100.0), min_size=2, max_size=12))
def test_the_interval_of_the_logarithm_has_its_closed_form(values):
    assume(np.ptp(np.log(values)) > 1e-6)
    expected = stats.ttest_1samp(np.log(values), 0.0).confidence_interval(0.95)
    scale = LogScale(0.001, 1000.0, 0.0, 1.0)
    sample = draws(values)
    assert interval(sample, scale) == pytest.approx((np.exp(expected.low), np.exp(expected.high)))
    assert centre(sample, scale) == pytest.approx(stats.gmean(values))


def test_the_linear_interval_covers_as_it_claims():
    rng, scale = np.random.default_rng(0), LinearScale(-9.0, 9.0, 0.0, 1.0)
    bounds = [interval(draws(rng.standard_normal(5)), scale) for _ in range(2000)]
    assert np.mean([low < 0.0 < high for low, high in bounds]) == pytest.approx(0.95, abs=0.02)


@pytest.mark.parametrize("kind", [LinearScale, LogScale])
def test_one_fold_has_no_interval(kind):
    assert interval(draws([2.0]), kind(1.0, 3.0, 0.0, 1.0)) is None
