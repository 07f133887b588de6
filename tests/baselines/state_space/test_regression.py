"""A regression maximises its expected log-density plus log-prior."""

import numpy as np
import pytest

from mocapbench.baselines.state_space.linear_gaussian import log_prior_density, regress

PRIOR = FRAMES, VARIANCE, RIDGE = (3.0, 0.5, 0.7)


def sums_of(y, x):
    return y.T @ y, y.T @ x, x.T @ x, np.full((1, 1), float(len(y)))


def objective(b, v, sums, prior):
    """Return the expected log-density plus log-prior."""
    yy, yx, xx, count = sums
    residual = yy - b @ yx.T - yx @ b.T + b @ xx @ b.T
    _, log_determinant = np.linalg.slogdet(v)
    density = -0.5 * (count[0, 0] * log_determinant + np.trace(np.linalg.solve(v, residual)))
    return density + log_prior_density(b, v, prior)


@pytest.mark.parametrize("seed", range(5))
def test_no_other_regression_is_better(seed):
    rng = np.random.default_rng(seed)
    y, x = rng.normal(size=(6, 2)), rng.normal(size=(6, 3))
    sums = sums_of(y, x)
    coefficients, covariance = regress(sums, PRIOR)
    peak = objective(coefficients, covariance, sums, PRIOR)
    for _ in range(50):
        root = np.linalg.cholesky(covariance) @ (np.eye(2) + 0.02 * rng.normal(size=(2, 2)))
        moved = coefficients + 0.02 * rng.normal(size=(2, 3))
        assert objective(moved, root @ root.T, sums, PRIOR) < peak


def test_without_frames_the_prior_decides():
    nothing = sums_of(np.zeros((0, 2)), np.zeros((0, 3)))
    found, covariance = regress(nothing, PRIOR)
    np.testing.assert_array_equal(found, np.zeros((2, 3)))
    np.testing.assert_allclose(covariance, 0.5 * np.eye(2))


def test_the_prior_counts_as_frames():
    """Frames of the prior added to the data give the fit of the data with the prior."""
    rng = np.random.default_rng(0)
    y, x = rng.normal(size=(6, 1)), rng.normal(size=(6, 2))
    added_x = np.vstack([x, np.sqrt(RIDGE) * np.eye(2)])
    added_y = np.vstack([y, np.zeros((2, 1))])
    coefficients, *_ = np.linalg.lstsq(added_x, added_y, rcond=None)
    residuals = added_y - added_x @ coefficients
    variance = (np.sum(residuals**2) + FRAMES * VARIANCE) / (6 + FRAMES)
    found, covariance = regress(sums_of(y, x), PRIOR)
    np.testing.assert_allclose(found, coefficients.T)
    np.testing.assert_allclose(covariance, [[variance]])
