from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from mocapbench.baselines import (
    CubicSplineImputer,
    HoldImputer,
    Interpolator,
    LinearImputer,
    MakimaImputer,
    PchipImputer,
)
from mocapbench.datasets import Recording

TIMES = np.array([0.0, 0.3, 1.0, 1.2, 2.0, 3.5, 4.0, 5.0])
HOLD, LINEAR, PCHIP, MAKIMA, SPLINE = INTERPOLATIONS = (
    HoldImputer(),
    LinearImputer(),
    PchipImputer(),
    MakimaImputer(),
    CubicSplineImputer(),
)

every_interpolation = pytest.mark.parametrize("model", INTERPOLATIONS, ids=repr)
every_continuous_one = pytest.mark.parametrize("model", INTERPOLATIONS[1:], ids=repr)
values_at_all_times = st.lists(st.floats(-100, 100), min_size=8, max_size=8).map(np.array)
some_frames = st.sets(st.integers(0, 7), min_size=1).map(sorted)


def recording(name, *columns):
    channels = tuple(f"c{d}" for d in range(len(columns)))
    return Recording(name, TIMES, np.column_stack(columns), channels, ("",) * len(columns))


def filled(model, truth, visible):
    given = truth.hide(~np.isin(np.arange(len(TIMES)), visible)[:, None])
    return model.fit([given]).impute([given])[0]


def curve(model, values, visible):
    return filled(model, recording("r", values), visible).mean[:, 0]


@every_interpolation
def test_it_is_marked_as_interpolation_and_states_no_distribution(model):
    assert isinstance(model, Interpolator)
    assert filled(model, recording("r", TIMES), [0, 7]).variance is None


@every_interpolation
@settings(max_examples=40)
@given(values=values_at_all_times, visible=some_frames)
def test_the_nearest_visible_value_holds_outside(model, values, visible):
    mean = curve(model, values, visible)
    np.testing.assert_allclose(mean[: visible[0]], values[visible[0]], atol=1e-9)
    np.testing.assert_allclose(mean[visible[-1] :], values[visible[-1]], atol=1e-9)


@every_continuous_one
@settings(max_examples=40)
@given(slope=st.floats(-9, 9), constant=st.floats(-9, 9), inner=some_frames)
def test_a_line_is_exact_through_any_two_points_or_more(model, slope, constant, inner):
    line = constant + slope * TIMES
    np.testing.assert_allclose(curve(model, line, [0, *inner, 7]), line, atol=1e-9)


@pytest.mark.parametrize("model", [HOLD, LINEAR, PCHIP], ids=repr)
@settings(max_examples=40)
@given(values=values_at_all_times, visible=some_frames)
def test_it_stays_between_the_visible_values_beside_it(model, values, visible):
    mean = curve(model, values, visible)
    for one, other in pairwise(visible):
        low, high = sorted((values[one], values[other]))
        assert (mean[one : other + 1] >= low - 1e-9).all()
        assert (mean[one : other + 1] <= high + 1e-9).all()


def test_hold_takes_the_last_visible_value():
    assert curve(HOLD, TIMES, [1, 4, 5]).tolist() == [0.3, 0.3, 0.3, 0.3, 2.0, 3.5, 3.5, 3.5]


def test_makima_overshoots_a_step_less_than_the_spline():
    step = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0])
    visible = [0, 1, 3, 5, 6, 7]
    spline, makima = (np.abs(curve(model, step, visible)[[2, 4]]) for model in (SPLINE, MAKIMA))
    assert makima[0] < spline[0]
    assert 0.0 < curve(MAKIMA, step, visible)[4] < 1.0


def makima_slope(before, left, right, after):
    """Return the slope between two intervals of slopes ``left`` and ``right`` and their neighbours.

    The formula of Moler and Ionita 2019.
    """
    weight = abs(after - right) + abs(after + right) / 2
    other = abs(left - before) + abs(left + before) / 2
    return (weight * left + other * right) / (weight + other)


def test_makima_has_the_slopes_of_its_definition():
    values = np.array([0.0, 1.0, 3.0, 2.0, 2.0, 5.0])
    slopes = np.diff(values)
    rise = makima_slope(*slopes[:4]) - makima_slope(*slopes[1:])
    middle = (values[2] + values[3]) / 2 + rise / 8  # of a cubic with these slopes at its ends
    times = np.insert(np.arange(6.0), 3, 2.5)
    given = Recording("r", times, np.insert(values, 3, np.nan)[:, None], ("c",), ("",))
    assert MAKIMA.fit([given]).impute([given])[0].mean[3, 0] == pytest.approx(middle)


@given(
    coefficients=st.lists(st.floats(-5, 5), min_size=4, max_size=4),
    n_visible=st.integers(1, 6),
)
def test_the_spline_is_exact_for_polynomials_that_its_knots_allow(coefficients, n_visible):
    degree = min(n_visible, 4) - 1
    truth = np.polynomial.Polynomial(coefficients[: degree + 1])(TIMES)
    visible = [0, *range(2, n_visible), 7] if n_visible > 1 else [3]
    np.testing.assert_allclose(curve(SPLINE, truth, visible), truth, atol=1e-8)


def test_the_spline_is_not_a_knot():
    visible = [0, 1, 3, 5, 6, 7]
    expected = CubicSpline(TIMES[visible], np.sin(TIMES[visible]), bc_type="not-a-knot")(TIMES)
    np.testing.assert_allclose(curve(SPLINE, np.sin(TIMES), visible), expected)


@every_interpolation
def test_a_channel_never_visible_takes_its_mean_in_training(model):
    train = recording("train", TIMES, TIMES)
    new = recording("new", np.full(8, np.nan), TIMES)
    np.testing.assert_allclose(model.fit([train]).impute([new])[0].mean[:, 0], TIMES.mean())
    with pytest.raises(ValueError, match=r"'new': expected a visible .* got none of \['c0'\]"):
        model.fit([new]).impute([new])


@every_interpolation
def test_a_recording_of_one_frame_takes_the_means(model):
    train = recording("train", TIMES, -TIMES)
    one = Recording("one", [0.0], [[3.0, np.nan]], train.channels, train.units)
    np.testing.assert_allclose(model.fit([train]).impute([one])[0].mean, [[3.0, -TIMES.mean()]])


@every_interpolation
def test_other_channels_are_refused(model):
    with pytest.raises(ValueError, match="expected channels"):
        model.fit([recording("train", TIMES)]).impute([recording("new", TIMES, TIMES)])
