import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines import PoseViterbi
from mocapbench.baselines.kriging.paths import (
    blend_paths,
    doubt_about_path,
    explained_share,
    match_paths,
    weigh_paths,
)
from mocapbench.datasets import Recording


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 6))
def test_weights_sum_to_one_and_the_best_path_has_the_largest(seed, n_paths):
    errors = np.random.default_rng(seed).gamma(1.0, size=n_paths)
    weights = weigh_paths(errors)
    assert weights.sum() == pytest.approx(1.0)
    assert weights.argmax() == errors.argmin()


def test_paths_that_predict_alike_leave_no_doubt():
    alike, weights = np.ones((3, 6, 2)), weigh_paths(np.array([1.0, 2.0, 5.0]))
    np.testing.assert_allclose(doubt_about_path(alike, weights), 0.0, atol=1e-30)


def test_one_path_says_nothing_of_others():
    np.testing.assert_array_equal(doubt_about_path(np.ones((1, 6, 2)), np.ones(1)), 0.0)


def test_the_doubt_is_that_of_one_more_draw():
    """With equal weights it is the sample variance times 1 + 1/K, without bias."""
    rng = np.random.default_rng(0)
    doubt = doubt_about_path(rng.normal(size=(4, 50_000, 1)), np.full(4, 0.25))
    assert doubt.mean() == pytest.approx(1.25, rel=0.02)


@pytest.mark.parametrize(
    ("errors", "total", "explained"),
    [([2.0, 5.0], 10.0, 0.8), ([20.0, 30.0], 10.0, -1.0), ([0.0], 0.0, 1.0), ([1.0], 0.0, -np.inf)],
)
def test_the_share_explained_is_that_of_the_best_path(errors, total, explained):
    assert explained_share(np.array(errors), total) == pytest.approx(explained)


def test_an_exact_path_has_all_the_weight():
    with np.errstate(all="raise", under="ignore"):
        np.testing.assert_array_equal(weigh_paths(np.array([0.0, 5.0])), [1.0, 0.0])


def blending(seed, n_paths=4):
    """Return weights of paths, their residuals (K, n), and the noise's covariance (n, n)."""
    rng = np.random.default_rng(seed)
    factor = rng.normal(size=(8, 8))
    weights = rng.dirichlet(np.ones(n_paths))
    return weights, rng.normal(size=(n_paths, 8)), 30.0 * (factor @ factor.T + np.eye(8))


def products(residuals, covariance):
    """Return the products of residuals where 30 of them count as one."""
    return 30.0 * residuals @ np.linalg.solve(covariance, residuals.T)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10_000))
def test_paths_are_blended_as_a_normal_prior_of_their_weights_tells(seed):
    """The blend is the conditional mean of the deviations of paths, given the mean's residual."""
    weights, residuals, covariance = blending(seed)
    mean = weights @ residuals
    deviations = mean - residuals  # of paths from their mean
    prior = deviations.T @ np.diag(weights) @ deviations
    told = prior @ np.linalg.solve(prior + covariance, mean)
    blended = blend_paths(weights, products(residuals, covariance))
    assert blended.sum() == pytest.approx(1.0)
    np.testing.assert_allclose(mean - blended @ residuals, told, atol=1e-9)


def test_the_order_of_paths_does_not_matter_in_a_blend():
    weights, residuals, covariance = blending(0)
    order, gram = [2, 0, 3, 1], products(residuals, covariance)
    moved = blend_paths(weights[order], gram[np.ix_(order, order)])
    np.testing.assert_allclose(moved, blend_paths(weights, gram)[order])


def test_paths_that_explain_all_of_the_visible_frames_are_not_moved():
    np.testing.assert_allclose(blend_paths(np.array([0.7, 0.3]), np.zeros((2, 2))), [0.7, 0.3])


def swing(name, n_frames, *, start=0.0, period=15):
    angle = start + 2 * np.pi * np.arange(n_frames) / period
    values = np.column_stack([np.sin(angle), np.cos(angle)])
    return Recording(name, np.arange(n_frames) / 30, values, ("hip", "knee"), ("deg",) * 2)


def test_a_recording_that_moves_otherwise_is_left_out():
    still = swing("still", 30)
    still = still.with_values(0.01 * still.values)
    matchers = [PoseViterbi(steps=4).fit([one]) for one in (swing("alike", 30), still)]
    hidden = np.zeros((30, 2), dtype=bool)
    hidden[10:15] = True
    paths, errors = match_paths(swing("new", 30, start=0.1).hide(hidden), matchers)
    assert paths.shape == (1, 30, 2)
    assert errors.shape == (1,)
