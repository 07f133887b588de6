import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.stats import norm

from mocapbench.metrics import (
    coverage_50,
    coverage_80,
    coverage_90,
    coverage_95,
    crps,
    pit,
    sharpness,
)

COVERAGES = (coverage_50, coverage_80, coverage_90, coverage_95)


@pytest.fixture(scope="module")
def exact(make):
    """20,000 entries drawn from the very Gaussians that are predicted."""
    rng = np.random.default_rng(1)
    mean, sd = rng.normal(size=(5000, 4)), rng.uniform(0.1, 3.0, (5000, 4))
    return make(rng.normal(mean, sd), mean, sd**2)


@pytest.mark.parametrize("metric", COVERAGES, ids=lambda metric: metric.name)
def test_coverage_of_exact_gaussians_is_the_level(exact, metric):
    level = metric.target
    four_sd = 4 * np.sqrt(level * (1 - level) / exact.truth.size)
    assert metric(exact).value == pytest.approx(level, abs=four_sd)


@pytest.mark.parametrize("metric", COVERAGES, ids=lambda metric: metric.name)
def test_the_interval_ends_at_its_quantile(make, metric):
    z = norm.ppf(0.5 + metric.target / 2)
    outcome = make([[1 + 2 * z * 0.999, 1 - 2 * z * 1.001]], 1.0, 4.0)
    np.testing.assert_array_equal(metric(outcome).parts["output"], [1.0, 0.0])


def test_wider_intervals_cover_more(draw):
    values = [metric(draw(2)).value for metric in COVERAGES]
    assert values == sorted(values)


def test_pit_of_evenly_spread_quantiles_is_uniform(make):
    quantiles = (np.arange(100) + 0.5) / 100
    score = pit(make(norm.ppf(quantiles)[:, None], 0.0, 1.0))
    np.testing.assert_allclose(score.parts["bin"], 0.1)
    assert score.value == pytest.approx(0.0, abs=1e-12)


def test_pit_is_greatest_if_all_entries_fall_into_one_bin(make):
    score = pit(make(np.full((7, 1), 50.0), 0.0, 1.0))
    assert score.parts["bin"][-1] == 1.0
    assert score.value == pytest.approx(0.9)


def test_pit_is_larger_for_too_wide_distributions(exact):
    wide = dataclasses.replace(exact, variance=4 * exact.variance)
    assert pit(exact).value < 0.02
    assert pit(wide).value > 0.1


def test_sharpness_is_the_mean_deviation(make):
    assert sharpness(make([[0.0, 0.0]], 0.0, [[1.0, 9.0]])).value == 2.0


@given(y=st.floats(-4, 4), mean=st.floats(-4, 4), sd=st.floats(0.3, 3))
def test_crps_is_the_integral_of_squared_distance_of_distributions(make, y, mean, sd):
    below, _ = quad(lambda x: norm.cdf(x, mean, sd) ** 2, mean - 12 * sd - 8, y)
    above, _ = quad(lambda x: norm.sf(x, mean, sd) ** 2, y, mean + 12 * sd + 8)
    assert crps(make([[y]], mean, sd**2)).value == pytest.approx(below + above, rel=1e-6)


def test_crps_of_a_sure_prediction_is_the_absolute_error(make):
    assert crps(make([[3.0]], 1.0, 1e-16)).value == pytest.approx(2.0)


@given(seed=st.integers(0, 2**32 - 1), scale=st.floats(0.1, 100), offset=st.floats(-10, 10))
def test_units_scale_crps_and_sharpness_and_leave_the_rest(draw, seed, scale, offset):
    outcome = draw(seed)
    rescaled = dataclasses.replace(
        outcome,
        truth=outcome.truth * scale + offset,
        mean=outcome.mean * scale + offset,
        variance=outcome.variance * scale**2,
    )
    for metric in (crps, sharpness):
        assert metric(rescaled).value == pytest.approx(metric(outcome).value * scale)
    for metric in COVERAGES:
        assert metric(rescaled).value == pytest.approx(metric(outcome).value)
