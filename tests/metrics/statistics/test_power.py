import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from mocapbench.metrics.statistics import (
    FEWEST_UNITS,
    MOST_UNITS,
    detectable_difference,
    deviation_interval,
    power_of_t_test,
    unit_means,
    units_needed,
)

numbers = st.integers(2, 300)
levels = st.floats(0.001, 0.2)
powers = st.floats(0.3, 0.99)
deviations = st.floats(0.01, 100.0)
effects = st.floats(0.05, 3.0)


@given(numbers, deviations, levels)
def test_without_a_difference_power_is_the_level(n, deviation, alpha):
    assert power_of_t_test(n, 0.0, deviation, alpha) == pytest.approx(alpha)


@given(numbers, effects, levels)
def test_more_units_a_greater_difference_and_a_greater_level_give_more_power(n, effect, alpha):
    power = power_of_t_test(n, effect, 1.0, alpha)
    slack = power - 1e-9
    assert power_of_t_test(n + 1, effect, 1.0, alpha) >= slack
    assert power_of_t_test(n, 1.1 * effect, 1.0, alpha) >= slack
    assert power_of_t_test(n, effect, 1.0, 1.1 * alpha) >= slack


@given(numbers, effects, deviations, levels)
def test_power_depends_on_the_size_of_the_difference_in_deviations(n, effect, deviation, alpha):
    power = power_of_t_test(n, effect, 1.0, alpha)
    for sign in (-1.0, 1.0):
        assert power_of_t_test(n, sign * effect * deviation, deviation, alpha) == pytest.approx(
            power
        )


@given(numbers, deviations, levels, powers)
def test_the_detectable_difference_has_the_power_asked_for(n, deviation, alpha, power):
    found = detectable_difference(n, deviation, alpha, power)
    assert power_of_t_test(n, found, deviation, alpha) == pytest.approx(power)


@given(effects, deviations, levels, powers)
def test_the_units_needed_are_the_least_that_detect_the_difference(effect, deviation, alpha, power):
    difference = effect * deviation
    n = units_needed(difference, deviation, alpha, power)
    assert n == int(n) >= FEWEST_UNITS
    assert detectable_difference(n, deviation, alpha, power) <= difference * (1.0 + 1e-9)
    if n > FEWEST_UNITS:
        assert detectable_difference(n - 1, deviation, alpha, power) > difference * (1.0 - 1e-9)


def test_the_textbook_has_these_numbers():
    """Of 80 % power at 5 %, as statsmodels and G*Power have them."""
    assert [units_needed(effect, 1.0) for effect in (0.2, 0.5, 0.8)] == [199, 34, 15]
    assert power_of_t_test(30, 0.5, 1.0) == pytest.approx(0.7539647)


@pytest.mark.parametrize("shares", [[1 / 12] * 12, [2 / 12] * 4 + [1 / 12] * 4])
def test_the_power_is_the_share_of_simulated_tests_that_find_the_difference(shares):
    """Of units whose variance is proportional to 1/s, as the test takes it."""
    rng, shares = np.random.default_rng(51), np.array(shares)
    spread = rng.standard_normal((40_000, len(shares))) / np.sqrt(len(shares) * shares)
    found = unit_means(0.8 + spread, shares)
    worth = float(found.freedom[0]) + 1.0
    deviation = math.sqrt(worth / len(shares))
    expected = power_of_t_test(worth, 0.8, deviation)
    assert np.mean(found.p <= 0.05) == pytest.approx(expected, abs=0.01)


@pytest.mark.parametrize("difference", [0.0, 1e-9])
def test_no_number_of_people_shows_next_to_no_difference(difference):
    assert units_needed(difference, 1.0) == math.inf
    assert power_of_t_test(MOST_UNITS, difference, 1.0) < 0.8


def test_great_differences_are_found_for_sure():
    for effect in (3.0, 10.0, 38.0, 1e3, 1e6):
        for n in (5, 30, 10_000):
            assert power_of_t_test(n, effect, 1.0) == pytest.approx(1.0, abs=0.01)


@given(deviations, st.floats(1.0, 500.0))
def test_the_interval_of_a_deviation_is_that_of_the_chi_square_distribution(deviation, freedom):
    low, high = deviation_interval(deviation, freedom)
    assert low < deviation < high
    ends = freedom * deviation**2 / np.array([high, low]) ** 2
    np.testing.assert_allclose(stats.chi2.cdf(ends, freedom), [0.025, 0.975])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((1, 1.0, 1.0), "two or more units, got 1"),
        ((math.nan, 1.0, 1.0), "two or more units, got nan"),
        ((5, 1.0, 0.0), "a standard deviation above 0, got 0.0"),
        ((5, 1.0, math.nan), "a standard deviation above 0, got nan"),
        ((5, 1.0, 1.0, 1.0), "a level between 0 and 1, got 1.0"),
    ],
)
def test_a_test_that_cannot_be_is_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        power_of_t_test(*arguments)


@pytest.mark.parametrize("power", [0.05, 0.01, 1.0, math.nan])
def test_a_power_of_at_most_the_level_or_of_1_is_refused(power):
    for plan in (detectable_difference, units_needed):
        with pytest.raises(ValueError, match="a power between the level"):
            plan(10, 1.0, 0.05, power)


def test_what_nobody_could_miss_is_found_for_sure():
    """SciPy has no number for the probability, below 1e-290, to miss it."""
    assert power_of_t_test(163, 3.0, 1.0, 0.125) == 1.0
