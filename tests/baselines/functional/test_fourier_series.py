import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.functional.fourier_series import fourier, norms, roughness, shift_matrices

H = 3
GRID = np.arange(200) / 200
COEFFICIENTS = np.random.default_rng(0).normal(size=2 * H + 1)


def _curve(phases):
    return fourier(phases, H) @ COEFFICIENTS


@pytest.mark.parametrize("order", [0, 1, 2])
def test_value_slope_and_curvature_agree_at_the_seam(order):
    step = 1e-3
    before, after = (
        np.diff(_curve(seam + step * np.arange(-order, order + 1)), order)[:: max(order, 1)]
        for seam in (0.0, 1.0)
    )
    np.testing.assert_allclose(before, after, rtol=1e-6)


@given(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_a_matrix_shifts_the_phase(phase, shift):
    (matrix,) = shift_matrices(np.array([shift]), H)
    np.testing.assert_allclose(matrix @ fourier(phase, H), fourier(phase + shift, H), atol=1e-9)


def test_functions_are_orthogonal_with_the_stated_mean_squares():
    basis = fourier(GRID, H)
    np.testing.assert_allclose(basis.T @ basis / len(GRID), np.diag(norms(H)), atol=1e-12)


def test_roughness_is_the_integral_of_the_squared_curvature():
    curvature = np.gradient(np.gradient(_curve(GRID[:2].max() * np.arange(-2, 203))))[2:-3]
    integral = ((curvature * len(GRID) ** 2) ** 2).mean()
    expected = 8.0 * np.pi**4 * (roughness(H) @ COEFFICIENTS**2)
    assert integral == pytest.approx(expected, rel=0.02)
