import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.kriging.held_out_stretches import HeldOutStretches, predict_frames

seeds = st.integers(0, 2**16)
STRETCH = np.array([0, 0, 0, 3, 3, 1, 1, 1, 1, 7])


def process(seed):
    """Return a covariance (10, 10) and values (10, 2)."""
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(10, 14))
    return root @ root.T, rng.normal(size=(10, 2))


@given(seed=seeds)
def test_every_stretch_is_predicted_from_the_others(seed):
    covariance, values = process(seed)
    held_out = HeldOutStretches(covariance, values, STRETCH)
    for number in np.unique(STRETCH):
        own = np.equal(STRETCH, number)
        others = ~own
        gain = covariance[np.ix_(own, others)] @ np.linalg.inv(covariance[np.ix_(others, others)])
        variance = np.diag(covariance[np.ix_(own, own)] - gain @ covariance[np.ix_(others, own)])
        errors = values[own] - gain @ values[others]
        np.testing.assert_allclose(held_out.errors[own], errors, rtol=1e-6, atol=1e-8)
        np.testing.assert_allclose(held_out.variances[own], variance, rtol=1e-6)


def test_the_score_is_the_density_of_each_entry_with_the_best_scale():
    covariance, values = process(0)
    held_out = HeldOutStretches(covariance, values, STRETCH)
    squares = held_out.errors**2 / held_out.variances[:, None]

    def without_constants(scale):
        return 0.5 * (np.log(scale * held_out.variances[:, None]) + squares / scale - 1.0).sum()

    assert held_out.score == pytest.approx(without_constants(held_out.scale))
    for other in (0.9, 1.1):
        assert without_constants(other * held_out.scale) > held_out.score


@given(seed=seeds)
def test_the_sensitivity_is_that_of_finite_differences(seed):
    covariance, values = process(seed)
    direction = np.random.default_rng([seed, 1]).normal(size=(10, 10))
    direction, step = direction + direction.T, 1e-6

    def score(change):
        return HeldOutStretches(covariance + change * direction, values, STRETCH).score

    slope = (score(step) - score(-step)) / (2.0 * step)
    sensitivity = HeldOutStretches(covariance, values, STRETCH).sensitivity
    np.testing.assert_array_equal(sensitivity, sensitivity.T)
    assert np.vdot(sensitivity, direction) == pytest.approx(slope, rel=1e-3, abs=1e-3)


def test_the_scale_of_the_covariance_does_not_matter():
    covariance, values = process(3)
    one, other = (HeldOutStretches(s * covariance, values, STRETCH) for s in (1.0, 9.0))
    np.testing.assert_allclose(other.errors, one.errors)
    assert other.score == pytest.approx(one.score)
    assert other.scale == pytest.approx(one.scale / 9.0)


def test_the_scale_is_the_mean_of_those_of_the_outputs():
    covariance, values = process(4)
    held_out = HeldOutStretches(covariance, values, STRETCH)
    each = [HeldOutStretches(covariance, values[:, [d]], STRETCH).scale for d in range(2)]
    np.testing.assert_allclose(held_out.scales, each)
    assert held_out.scale == pytest.approx(np.mean(each))


def test_a_covariance_that_is_none_is_refused():
    with pytest.raises(np.linalg.LinAlgError, match="positive definite"):
        assert HeldOutStretches(-np.eye(10), process(0)[1], STRETCH).score


@given(seed=seeds)
def test_predictions_are_those_of_a_dense_gaussian_of_which_half_is_read(seed):
    covariance, values = process(seed)
    cross = np.random.default_rng([seed, 1]).normal(size=(3, 10))
    gain = cross @ np.linalg.inv(covariance)
    below = np.where(np.tri(10, dtype=bool), covariance, np.nan)
    mean, explained = predict_frames(below, cross, values)
    np.testing.assert_allclose(mean, gain @ values, rtol=1e-6, atol=1e-8)
    np.testing.assert_allclose(explained, (gain * cross).sum(axis=1), rtol=1e-6, atol=1e-8)
