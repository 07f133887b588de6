"""Expectations under Q against sums over styles, states and frames."""

import numpy as np
import pytest

from mocapbench.baselines.alignment.cycle_model import (
    distance,
    emission,
    log_likelihood,
    residuals,
    roughness,
)
from mocapbench.baselines.alignment.ring import solve_rings


@pytest.fixture
def posed(pose):
    return pose(0, n_styles=2, n_states=7)


def expected_log_density(posed, k, i, m, c):
    """Return the expected log-density of the visible entries of one frame in one state."""
    sequences, state = posed.sequences, posed.state
    precision, seen = state.precisions[c], sequences.visible[k, i] > 0
    deviation = sequences.values[k, i] - state.cycles.mean[m, c]
    squares = deviation**2 + state.cycles.variance[m, c]
    terms = 0.5 * np.log(precision / (2 * np.pi)) - 0.5 * precision * squares
    return terms[seen].sum()


def test_the_emission_is_averaged_over_styles(posed):
    sequences, state = posed.sequences, posed.state
    precisions = state.precisions
    terms = emission(sequences, state.cycles, precisions, state.labels)
    for k, length in enumerate(sequences.lengths):
        for i in range(length):
            for m in range(7):
                by_style = [expected_log_density(posed, k, i, m, c) for c in range(2)]
                assert terms[k, i, m] == pytest.approx(state.labels[k] @ by_style, abs=1e-9)
        np.testing.assert_array_equal(terms[k, length:], 0.0)


def test_the_likelihood_of_a_style_is_averaged_over_states(posed):
    scores, occupancy = log_likelihood(posed.state, posed.sequences), posed.state.paths.occupancy
    for k, length in enumerate(posed.sequences.lengths):
        for c in range(2):
            expected = sum(
                occupancy[k, i, m] * expected_log_density(posed, k, i, m, c)
                for i in range(length)
                for m in range(7)
            )
            assert scores[k, c] == pytest.approx(expected, abs=1e-9)


def test_expected_squared_residuals_are_positive(posed):
    visible = posed.sequences.counts[:, None] > 0
    assert (residuals(posed.state, posed.sequences)[np.repeat(visible, 2, axis=1)] > 0).all()


def test_roughness_and_distance_are_expectations_under_a_gaussian():
    """Against the dense covariance of one ring."""
    rng = np.random.default_rng(0)
    n_states, edge, ground = 6, 2.0, rng.uniform(0.5, 2.0, 6)
    ring = solve_rings(edge, ground[:, None, None], rng.normal(size=(6, 1, 1)))
    identity = np.eye(n_states)
    laplacian = 2 * identity - np.roll(identity, 1, axis=0) - np.roll(identity, -1, axis=0)
    covariance = np.linalg.inv(edge * laplacian + np.diag(ground))
    reference = rng.normal(size=(n_states, 1))
    deviation = ring.mean[:, 0] - reference
    expected = (deviation.T @ laplacian @ deviation).item() + np.trace(laplacian @ covariance)
    assert roughness(ring, reference) == pytest.approx(expected)
    assert distance(ring, reference) == pytest.approx((deviation**2).sum() + np.trace(covariance))
