"""The priors of a cycle: normalisers, and the precisions that are best for given statistics."""

import numpy as np
import pytest

from mocapbench.baselines.alignment.priors import PRIORS

N_STATES = 7
PRECISIONS = [(0.3, 0.1), (20.0, 0.01), (1e-3, 5.0)]


def precision_matrix(smoothness, closeness):
    identity = np.eye(N_STATES)
    laplacian = 2 * identity - np.roll(identity, 1, axis=0) - np.roll(identity, -1, axis=0)
    return smoothness * laplacian + closeness * identity


@pytest.mark.parametrize("name", ["normalised", "centred"])
@pytest.mark.parametrize(("smoothness", "closeness"), PRECISIONS)
def test_the_normaliser_is_that_of_a_gaussian(name, smoothness, closeness):
    _, log_determinant = np.linalg.slogdet(precision_matrix(smoothness, closeness))
    expected = 0.5 * (log_determinant - N_STATES * np.log(2 * np.pi))
    value = PRIORS[name].log_normaliser(smoothness, closeness, N_STATES)
    assert value == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("name", PRIORS)
@pytest.mark.parametrize(("smoothness", "closeness"), PRECISIONS)
def test_the_best_precisions_maximise_the_expected_log_prior(name, smoothness, closeness):
    prior, roughness, distance = PRIORS[name], 4.0, 9.0

    def expected(smoothness, closeness):
        energy = smoothness * roughness + closeness * distance
        return prior.log_normaliser(smoothness, closeness, N_STATES) - 0.5 * energy

    best_smoothness = prior.smoothness(closeness, N_STATES, roughness)
    best_closeness = prior.closeness(smoothness, N_STATES, distance)
    for factor in (0.9, 1.1):
        at_smoothness = expected(factor * best_smoothness, closeness)
        assert at_smoothness <= expected(best_smoothness, closeness) + 1e-9
        at_closeness = expected(smoothness, factor * best_closeness)
        assert at_closeness <= expected(smoothness, best_closeness) + 1e-9


@pytest.mark.parametrize("name", PRIORS)
def test_precisions_stay_positive_for_large_statistics(name):
    assert PRIORS[name].smoothness(0.01, N_STATES, 1e12) > 0
    assert PRIORS[name].closeness(0.01, N_STATES, 1e12) > 0


def test_only_the_centred_prior_compares_steps_with_the_parent():
    parent = np.random.default_rng(0).normal(size=(N_STATES, 2))
    np.testing.assert_array_equal(PRIORS["centred"].reference(parent), parent)
    for name in ("normalised", "paper"):
        np.testing.assert_array_equal(PRIORS[name].reference(parent), np.zeros_like(parent))
