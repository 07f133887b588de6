import numpy as np
import pytest

from mocapbench.baselines.kriging import channel_process
from mocapbench.baselines.kriging.channel_process import (
    TYPICAL,
    ChannelPairs,
    learn_channel_process,
    predict_channels,
    prior_variances,
)
from mocapbench.baselines.kriging.described_frames import DescribedFrames
from mocapbench.baselines.kriging.held_out_stretches import noise_variance

N_FRAMES, SPREAD = 90, np.ones(2)


def frames(seed=0):
    rng = np.random.default_rng(seed)
    phase = np.cumsum(rng.uniform(0.0, 0.3, N_FRAMES))
    description = np.column_stack([np.sin(phase), np.cos(phase)])
    place = np.concatenate([np.arange(60), np.arange(30)])
    return DescribedFrames(description, place, np.repeat([0, 4], [60, 30]))


def values(given, noise, seed=1):
    sines, cosines = given.description.T
    clean = np.column_stack([sines, cosines**2])
    rough = clean + noise * np.random.default_rng(seed).normal(size=clean.shape)
    return (rough - rough.mean(axis=0)) / rough.std(axis=0)


@pytest.mark.parametrize("n_rows", [3, 256])
def test_predictions_are_those_of_a_dense_gaussian(monkeypatch, n_rows):
    monkeypatch.setattr(channel_process, "_ROWS", n_rows)
    given, process = frames(), (TYPICAL, np.array([2.0, 3.0]))
    known, wanted = np.arange(20, N_FRAMES), np.arange(20)
    shown = values(given, 0.1)
    covariance = ChannelPairs.of(given, given).covariance(TYPICAL)
    covariance += noise_variance(TYPICAL) * np.eye(N_FRAMES)
    gain = covariance[np.ix_(wanted, known)] @ np.linalg.inv(covariance[np.ix_(known, known)])
    rest = np.diag(covariance[np.ix_(wanted, wanted)] - gain @ covariance[np.ix_(known, wanted)])
    mean, variance = predict_channels(given.at(known), shown[known], given.at(wanted), *process)
    np.testing.assert_allclose(mean, gain @ shown[known], atol=1e-9)
    np.testing.assert_allclose(variance, np.outer(rest, [2.0, 3.0]), rtol=1e-4)


@pytest.mark.parametrize("noise", [0.01, 0.1, 0.5])
def test_what_is_learnt_says_how_far_it_errs(noise):
    ratios = []
    for seed in range(6):
        given = frames(seed)
        shown, gap = values(given, noise, seed), np.arange(20, 35)
        known = np.setdiff1d(np.arange(N_FRAMES), gap)
        process = learn_channel_process(given.at(known), shown[known], SPREAD, 0, 16.0)
        mean, variance = predict_channels(given.at(known), shown[known], given.at(gap), *process)
        ratios.append(np.mean((mean - shown[gap]) ** 2 / variance))
    assert 0.3 < np.mean(ratios) < 2.0


def test_the_scale_of_a_channel_does_not_change_what_is_learnt():
    given, factors = frames(), np.array([1.0, 100.0])
    shown = values(given, 0.1)
    one = learn_channel_process(given, shown, SPREAD, 0, 16.0)
    other = learn_channel_process(given, shown * factors, SPREAD * factors**2, 0, 16.0)
    np.testing.assert_allclose(other[0], one[0])
    np.testing.assert_allclose(other[1], one[1] * factors**2)


def test_one_frame_tells_little_of_the_scale():
    given = frames().at(np.arange(1))
    parameters, scales = learn_channel_process(given, np.full((1, 2), 1e-3), SPREAD, 0, 5.0)
    typical = 1.0 / prior_variances(given, parameters)
    assert (scales > typical).all()
    assert (scales < 4.0 * typical).all()
