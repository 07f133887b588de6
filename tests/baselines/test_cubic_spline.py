import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from mocapbench.baselines.cubic_spline import CubicSplineImputer
from mocapbench.datasets import Recording

TIMES = np.array([0.0, 0.3, 1.0, 1.2, 2.0, 3.5, 4.0, 5.0])


def recording(name, *columns):
    channels = tuple(f"c{d}" for d in range(len(columns)))
    return Recording(name, TIMES, np.column_stack(columns), channels, ("",) * len(columns))


def filled(truth, visible):
    given = truth.hide(~np.isin(np.arange(len(TIMES)), visible)[:, None])
    return CubicSplineImputer().fit([given]).impute([given])[0]


@given(
    coefficients=st.lists(st.floats(-5, 5), min_size=4, max_size=4),
    n_visible=st.integers(1, 6),
)
def test_a_polynomial_of_the_order_that_the_knots_allow_is_exact(coefficients, n_visible):
    degree = min(n_visible, 4) - 1
    truth = recording("r", np.polynomial.Polynomial(coefficients[: degree + 1])(TIMES))
    inner = [0, *range(2, n_visible), 7] if n_visible > 1 else [3]
    np.testing.assert_allclose(filled(truth, inner).mean, truth.values, atol=1e-8)


def test_it_is_not_a_knot():
    truth = recording("r", np.sin(TIMES))
    visible = [0, 1, 3, 5, 6, 7]
    expected = CubicSpline(TIMES[visible], np.sin(TIMES[visible]), bc_type="not-a-knot")(TIMES)
    np.testing.assert_allclose(filled(truth, visible).mean[:, 0], expected)


def test_the_nearest_visible_value_holds_outside():
    mean = filled(recording("r", np.exp(TIMES)), [2, 3, 4, 5]).mean[:, 0]
    np.testing.assert_allclose(mean[:2], np.exp(TIMES[2]), rtol=1e-14)
    np.testing.assert_allclose(mean[6:], np.exp(TIMES[5]), rtol=1e-14)


def test_channels_are_filled_apart():
    truth = recording("r", np.sin(TIMES), TIMES**3)
    given = truth.hide(np.column_stack([np.arange(8) == 4, np.arange(8) == 1]))
    both = CubicSplineImputer().fit([given]).impute([given])[0].mean
    for d in range(2):
        alone = given.select([f"c{d}"])
        one = CubicSplineImputer().fit([alone]).impute([alone])[0].mean
        np.testing.assert_array_equal(both[:, [d]], one)


def test_a_channel_never_visible_takes_its_mean_in_training():
    train = recording("train", TIMES, TIMES)
    new = recording("new", np.full(8, np.nan), TIMES)
    model = CubicSplineImputer().fit([train])
    np.testing.assert_allclose(model.impute([new])[0].mean[:, 0], TIMES.mean())
    with pytest.raises(ValueError, match=r"'new': expected a visible .* got none of \['c0'\]"):
        CubicSplineImputer().fit([new]).impute([new])


def test_it_states_no_distribution():
    assert filled(recording("r", TIMES), [0, 7]).variance is None


def test_other_channels_are_refused():
    model = CubicSplineImputer().fit([recording("train", TIMES)])
    with pytest.raises(ValueError, match="expected channels"):
        model.impute([recording("new", TIMES, TIMES)])
