from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.kriging.conditioned import (
    ConditionedFrames,
    copy_gaps,
    growth_of_variance,
)


def frames(seed, n=12):
    """Return a random covariance, which frames are visible, and residuals there."""
    rng = np.random.default_rng(seed)
    factor = rng.normal(size=(n, n))
    visible = rng.random(n) < 0.6
    visible[[0, 1, 2]] = True
    prior, trend = factor @ factor.T, np.empty((n, 0))
    return ConditionedFrames(prior, 0.3, visible, trend), rng.normal(size=(visible.sum(), 3))


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000))
def test_moments_are_those_of_the_joint_normal(seed):
    process, residuals = frames(seed)
    hidden, visible = ~process.visible, process.visible
    noisy = process.prior + 0.3 * np.eye(len(visible))
    precision = np.linalg.inv(noisy)
    block = np.linalg.inv(precision[np.ix_(hidden, hidden)])
    expected = -block @ precision[np.ix_(hidden, visible)] @ residuals
    np.testing.assert_allclose(process.mean(residuals)[hidden], expected, atol=1e-7)
    np.testing.assert_allclose(process.variance[hidden], np.diag(block), rtol=1e-7)
    inverse = np.linalg.inv(noisy[np.ix_(visible, visible)])
    scales = np.diag(residuals.T @ inverse @ residuals) / visible.sum()
    np.testing.assert_allclose(process.scales(residuals, 1e-300), scales)


def test_products_of_residuals_are_those_of_whitened_ones():
    process, one = frames(0)
    both, scales = np.array([one, one**2]), np.array([0.5, 1.0, 2.0])
    noisy = (process.prior + process.noise * np.eye(12))[np.ix_(process.visible, process.visible)]
    white = np.linalg.solve(np.linalg.cholesky(noisy), both) / np.sqrt(scales)
    expected = [[(left * right).sum() for right in white] for left in white]
    np.testing.assert_allclose(process.products(both, scales), expected)


def test_evidence_differs_as_the_density_of_a_student_t():
    """Up to a constant, the evidence is −½ ln|K| − n/2 ln rᵀK⁻¹r."""
    (one, residuals), (two, _) = frames(0), frames(0)
    two = replace(two, prior=2.0 * two.prior)

    def evidence(process):
        among = process.prior[np.ix_(process.visible, process.visible)]
        among = among + process.noise * np.eye(len(among))
        quadratic = np.diag(residuals.T @ np.linalg.solve(among, residuals))
        return -0.5 * np.linalg.slogdet(among)[1] - 0.5 * len(among) * np.log(quadratic)

    found = [process.log_evidence(process.scales(residuals, 1e-300)) for process in (one, two)]
    np.testing.assert_allclose(found[1] - found[0], evidence(two) - evidence(one))


@pytest.mark.parametrize(("n_visible", "factor"), [(1, 3.0), (2, 3.0), (3, 3.0), (12, 1.2)])
def test_fewer_visible_frames_leave_more_doubt_of_the_scale(n_visible, factor):
    visible = np.arange(20) < n_visible
    process = ConditionedFrames(np.eye(20), 1.0, visible, np.empty((20, 0)))
    assert process.doubt_of_scale == pytest.approx(factor)


def with_trend(seed, n=12):
    """Return a process with a constant and a slope, and residuals at its visible frames."""
    process, residuals = frames(seed, n)
    return replace(process, trend=np.column_stack([np.ones(n), np.arange(n)])), residuals


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000))
def test_a_free_trend_is_the_limit_of_one_with_a_wide_prior(seed):
    process, residuals = with_trend(seed)
    wide = 1e7 * process.trend @ process.trend.T
    proper = replace(process, prior=process.prior + wide, trend=process.trend[:, :0])
    np.testing.assert_allclose(process.mean(residuals), proper.mean(residuals), atol=1e-3)
    np.testing.assert_allclose(process.variance, proper.variance, rtol=1e-3, atol=1e-3)
    freedom = process.visible.sum() - 2
    sums = [each.scales(residuals, 1e-300) for each in (process, proper)]
    np.testing.assert_allclose(
        sums[0] * max(freedom, 1), sums[1] * process.visible.sum(), rtol=1e-3
    )


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000), st.floats(-1e4, 1e4), st.floats(-1e3, 1e3))
def test_what_the_trend_can_express_is_added_to_the_mean_and_nothing_else(seed, constant, slope):
    process, residuals = with_trend(seed)
    added = (process.trend @ [constant, slope])[:, None]
    moved = residuals + added[process.visible]
    np.testing.assert_allclose(process.mean(moved), process.mean(residuals) + added, atol=1e-6)
    scales = process.scales(residuals, 1e-300)
    np.testing.assert_allclose(process.scales(moved, 1e-300), scales, rtol=1e-4, atol=1e-6)


def test_a_trend_costs_as_many_degrees_of_freedom_as_it_has_coefficients():
    visible = np.arange(20) < 8
    process = ConditionedFrames(np.eye(20), 1.0, visible, np.ones((20, 2)) * [1.0, 0.0])
    assert process.doubt_of_scale == pytest.approx(6.0 / 4.0)


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000))
def test_left_out_frames_are_told_as_hidden_ones_are(seed):
    process, residuals = with_trend(seed, 20)
    scales = process.scales(residuals, 1e-300)
    numbers, squares, expected = np.flatnonzero(process.visible), 0.0, 0.0
    stretches = [np.array([1, 2]), np.array([4])]
    for stretch in stretches:
        hidden = replace(process, visible=process.visible & ~np.isin(range(20), numbers[stretch]))
        told = hidden.mean(np.delete(residuals, stretch, axis=0))[numbers[stretch]]
        squares = squares + ((told - residuals[stretch]) ** 2).sum(axis=0)
        expected = expected + hidden.variance[numbers[stretch]].sum() * scales
    sums = process.leave_out(stretches, residuals, scales)
    np.testing.assert_allclose(sums[0], squares, rtol=1e-5)
    np.testing.assert_allclose(sums[1], process.doubt_of_scale * expected, rtol=1e-6)


@given(st.lists(st.booleans(), min_size=1, max_size=40).map(np.array))
def test_copies_of_gaps_lie_between_visible_frames_that_follow_each_other(visible):
    numbers = np.flatnonzero(visible)
    for stretch in copy_gaps(visible):
        frames = numbers[np.arange(stretch[0] - 1, stretch[-1] + 2)]
        np.testing.assert_array_equal(frames, np.arange(frames[0], frames[-1] + 1))


def test_copies_are_as_long_as_the_median_gap_where_there_is_room():
    visible = np.ones(60, dtype=bool)
    visible[[*range(10, 14), *range(30, 34), 50]] = False
    assert {len(stretch) for stretch in copy_gaps(visible)} == {4}
    visible[2:58] = False
    assert copy_gaps(visible) == []


def test_variances_grow_by_the_errors_of_all_channels_and_never_shrink():
    assert growth_of_variance(np.array([[6.0, 0.0], [1.0, 1.0]])) == 3.0
    assert growth_of_variance(np.array([[0.5, 0.0], [1.0, 1.0]])) == 1.0
    assert growth_of_variance(np.zeros((2, 3))) == 1.0
