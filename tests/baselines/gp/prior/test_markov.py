import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.gp.prior.kernels import KERNELS
from mocapbench.baselines.gp.prior.markov import is_markov, state_order, steps

ORDERS = {"matern12": 1, "matern32": 2, "matern52": 3}
LAGS = st.floats(1e-9, 1e3)


@pytest.fixture(params=sorted(ORDERS))
def kernel(request):
    return KERNELS[request.param]


def _one(kernel, lag, lengthscale=0.7):
    transition, noise, *_ = steps(kernel, np.array([lag]), np.array([lengthscale]))
    return transition[0, 0], noise[0, 0]


@pytest.mark.parametrize("name", sorted(ORDERS))
def test_the_state_holds_one_coordinate_per_derivative(name):
    assert state_order(KERNELS[name]) == ORDERS[name]


def test_an_infinitely_smooth_kernel_has_no_finite_state():
    assert not is_markov(KERNELS["rbf"])
    with pytest.raises(ValueError, match=r"expected a kernel with a finite state.*got RBF"):
        steps(KERNELS["rbf"], np.ones(1), np.ones(1))


@given(lag=st.floats(0.0, 100.0))
@settings(deadline=None)
def test_the_first_coordinate_has_the_kernel_as_its_covariance(lag):
    for name in ORDERS:
        transition, _ = _one(KERNELS[name], lag)
        expected = KERNELS[name].value(np.array(lag), 0.7)
        assert transition[0, 0] == pytest.approx(float(expected), rel=1e-12)


@given(lag=LAGS)
@settings(deadline=None)
def test_the_stationary_covariance_is_the_identity(lag):
    for name, order in ORDERS.items():
        transition, noise = _one(KERNELS[name], lag)
        np.testing.assert_allclose(transition @ transition.T + noise, np.eye(order), atol=1e-13)


@given(first=LAGS, second=LAGS)
@settings(deadline=None)
def test_two_steps_are_one_step_of_the_summed_lag(first, second):
    for name in ORDERS:
        (one, noise_one), (two, noise_two), (both, noise_both) = (
            _one(KERNELS[name], lag) for lag in (first, second, first + second)
        )
        np.testing.assert_allclose(two @ one, both, atol=1e-13)
        np.testing.assert_allclose(two @ noise_one @ two.T + noise_two, noise_both, atol=1e-13)


@pytest.mark.parametrize("lag", [1e-2, 1e-4, 1e-6])
def test_the_noise_of_a_short_step_keeps_its_digits(kernel, lag):
    transition, half = _one(kernel, lag)
    _, whole = _one(kernel, 2.0 * lag)
    np.testing.assert_allclose(transition @ half @ transition.T + half, whole, rtol=1e-11)


def test_a_lag_of_zero_keeps_the_state_and_an_infinite_lag_forgets_it(kernel):
    identity = np.eye(state_order(kernel))
    for lag, law in ((0.0, (identity, 0.0 * identity)), (np.inf, (0.0 * identity, identity))):
        for value, expected in zip(_one(kernel, lag), law, strict=True):
            np.testing.assert_allclose(value, expected, atol=1e-15)


@pytest.mark.parametrize("lag", [0.01, 0.3, 2.0])
def test_gradients_are_derivatives_in_the_log_lengthscale(kernel, lag):
    (*_, by_transition, by_noise), h = steps(kernel, np.array([lag]), np.array([0.7])), 1e-5
    above, below = (_one(kernel, lag, 0.7 * np.exp(sign * h)) for sign in (1.0, -1.0))
    slopes = [(up - down) / (2.0 * h) for up, down in zip(above, below, strict=True)]
    np.testing.assert_allclose(by_transition[0, 0], slopes[0], atol=1e-9)
    np.testing.assert_allclose(by_noise[0, 0], slopes[1], atol=1e-9)
