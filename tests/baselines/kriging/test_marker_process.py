import numpy as np
import pytest

from mocapbench.baselines.kriging.described_frames import DescribedFrames
from mocapbench.baselines.kriging.marker_process import (
    FramePairs,
    learn_marker_process,
    predict_marker,
)

N_FRAMES = 90


def frames(seed=0):
    """Return frames of two recordings, 60 and 30 at 30 a second, whose shapes change smoothly."""
    rng = np.random.default_rng(seed)
    phase = np.cumsum(rng.uniform(0.0, 0.3, N_FRAMES))
    shapes = np.column_stack([np.sin(phase), np.cos(phase)])
    changes = np.column_stack([np.cos(phase), -np.sin(phase)])
    parts = np.stack([shapes, 0.5 * changes, 0.3 * shapes], axis=1)
    times = np.concatenate([np.arange(60), np.arange(30)]) / 30
    return DescribedFrames(parts, times, np.repeat([0, 4], [60, 30]))


def values(given, noise, seed=1):
    """Return where a marker is (N, 3) that follows the shape."""
    sines, cosines = given.description[:, 0].T
    clean = np.column_stack([sines, cosines**2, sines * cosines])
    rough = clean + noise * np.random.default_rng(seed).normal(size=clean.shape)
    rough = rough - rough.mean(axis=0)
    return rough / rough.std()


def test_derivatives_are_those_of_finite_differences():
    pairs = FramePairs.of(frames(), frames().at(np.arange(7)))
    parameters, step = np.array([0.2, -0.4, -1.0, -3.0]), 1e-6
    for number, derivative in enumerate(pairs.derivatives(parameters)):
        change = step * (np.arange(4) == number)
        slope = pairs.covariance(parameters + change) - pairs.covariance(parameters - change)
        np.testing.assert_allclose(derivative, slope / (2.0 * step), atol=1e-8)


def test_covariances_are_positive_semidefinite():
    pairs = FramePairs.of(frames(), frames())
    for seed in range(5):
        parameters = np.random.default_rng(seed).normal(size=4)
        assert np.linalg.eigvalsh(pairs.covariance(parameters)).min() > -1e-9


def test_predictions_are_those_of_a_dense_gaussian():
    given, process = frames(), (np.log([1.5, 0.5, 0.3, 0.1]), 2.0)
    known, wanted = np.arange(20, N_FRAMES), np.arange(20)
    where = values(given, 0.1)
    covariance = FramePairs.of(given, given).covariance(process[0])
    covariance += 0.1**2 * np.eye(N_FRAMES)
    gain = covariance[np.ix_(wanted, known)] @ np.linalg.inv(covariance[np.ix_(known, known)])
    expected = np.diag(
        covariance[np.ix_(wanted, wanted)] - gain @ covariance[np.ix_(known, wanted)]
    )
    mean, variance = predict_marker(given.at(known), where[known], given.at(wanted), *process)
    np.testing.assert_allclose(mean, gain @ where[known], atol=1e-3)
    np.testing.assert_allclose(variance, 2.0 * expected, rtol=1e-3)


@pytest.mark.parametrize("noise", [0.01, 0.1, 0.5])
def test_what_is_learnt_says_how_far_it_errs(noise):
    ratios = []
    for seed in range(6):
        given = frames(seed)
        where = values(given, noise, seed)
        gap = np.arange(20, 35)
        known = np.setdiff1d(np.arange(N_FRAMES), gap)
        process = learn_marker_process(given.at(known), where[known], 0.5)
        mean, variance = predict_marker(given.at(known), where[known], given.at(gap), *process)
        ratios.append(np.mean((mean - where[gap]) ** 2 / variance[:, None]))
    assert 0.3 < np.mean(ratios) < 2.0


def test_a_marker_that_is_moves_a_hundredth_as_far_is_a_hundred_times_as_sure():
    """Parameters are those of ratios; variances have the unit of values, squared."""
    given = frames()
    where, known = values(given, 0.1), np.r_[:20, 35:N_FRAMES]
    far, near = (
        learn_marker_process(given.at(known), scale * where[known], 0.5) for scale in (1.0, 1e-2)
    )
    np.testing.assert_allclose(near[0], far[0], rtol=1e-6)
    assert near[1] == pytest.approx(1e-4 * far[1])
