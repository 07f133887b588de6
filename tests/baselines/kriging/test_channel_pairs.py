import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.kriging.channel_process import ChannelPairs, prior_variances
from mocapbench.baselines.kriging.described_frames import DescribedFrames

seeds = st.integers(0, 2**16)


def frames(seed):
    """Return 30 frames of three recordings, one below the other."""
    rng = np.random.default_rng(seed)
    place, recording = rng.integers(20, size=30), np.sort(rng.integers(3, size=30))
    return DescribedFrames(rng.normal(size=(30, 4)), place, recording)


def dense(one, other, parameters):
    """Return the covariance of two frames as the docstring of the module has it."""
    length, linear, own, drift, lasting, _ = np.exp(parameters)
    together = one.recording == other.recording
    distance = np.sum((one.description - other.description) ** 2)
    shared = (
        1 + linear**2 * one.description @ other.description + (1 + distance / length**2) ** -0.5
    )
    lag = np.sqrt(3.0) * abs(one.times - other.times) / lasting
    return (1 + own**2 * together) * shared + drift**2 * together * (1 + lag) * np.exp(-lag)


@given(seed=seeds)
def test_the_covariance_is_the_formula(seed):
    given, parameters = frames(seed), np.random.default_rng([seed, 1]).normal(size=6)
    covariance = ChannelPairs.of(given, given.at(np.arange(4))).covariance(parameters)
    expected = [[dense(given.at(i), given.at(j), parameters) for j in range(4)] for i in range(30)]
    np.testing.assert_allclose(covariance, expected, rtol=1e-6, atol=1e-6)


@given(seed=seeds)
def test_derivatives_are_those_of_finite_differences(seed):
    given, step = frames(seed), 1e-5
    pairs, parameters = ChannelPairs.of(given, given), np.random.default_rng(seed).normal(size=6)
    largest = pairs.covariance(parameters).max()
    for number, derivative in enumerate(pairs.derivatives(parameters)):
        change = step * (np.arange(6) == number)
        slope = pairs.covariance(parameters + change) - pairs.covariance(parameters - change)
        np.testing.assert_allclose(derivative, slope / (2 * step), atol=1e-7 * largest)


@given(seed=seeds)
def test_covariances_are_positive_semidefinite_with_their_prior_variances(seed):
    given, parameters = frames(seed), np.random.default_rng([seed, 2]).normal(size=6)
    covariance = ChannelPairs.of(given, given).covariance(parameters)
    assert np.linalg.eigvalsh(covariance).min() > -1e-6 * np.trace(covariance)
    np.testing.assert_allclose(np.diag(covariance), prior_variances(given, parameters), rtol=1e-5)
