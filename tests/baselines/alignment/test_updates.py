"""Each update's closed form; ``test_bound`` checks that none lowers the bound."""

from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines.alignment import updates
from mocapbench.baselines.alignment.cycle_model import lower_bound


@pytest.fixture
def posed(pose):
    return pose(2, n_styles=3, n_states=7)


def updated(posed, update):
    return update(posed.state, posed.sequences, posed.hyper)


@pytest.mark.parametrize("name", [name for name in updates.__all__ if "update_" in name])
def test_an_update_is_at_its_own_fixed_point(posed, name):
    """The factor that it sets is the best given all others, so that a second one gains nothing."""
    update = getattr(updates, name)
    once = updated(posed, update)
    twice = update(once, posed.sequences, posed.hyper)
    values = [lower_bound(state, posed.sequences, posed.hyper) for state in (once, twice)]
    assert values[1] == pytest.approx(values[0], rel=1e-9)


def test_probabilities_sum_to_one(posed):
    np.testing.assert_allclose(updated(posed, updates.update_labels).labels.sum(axis=1), 1.0)
    weights = updated(posed, updates.update_weights).weights
    np.testing.assert_allclose(weights.sum(), 1.0)
    jumps = updated(posed, updates.update_jumps).jumps
    np.testing.assert_allclose(jumps.sum(axis=1), 1.0)
    assert (weights > 0).all()
    assert (jumps > 0).all()


def test_a_style_without_visible_entries_keeps_its_precision(posed):
    labels = np.tile([1.0, 0.0, 0.0], (4, 1))
    state = replace(posed.state, labels=labels)
    after = updates.update_precisions(state, posed.sequences, posed.hyper)
    precisions = after.precisions
    np.testing.assert_array_equal(precisions[1:], state.precisions[1:])
    assert (precisions <= posed.hyper.max_precision).all()


def test_without_evidence_a_cycle_has_the_moments_of_its_prior(pose):
    posed = pose(3, hidden=1.1, prior="centred")
    state = updated(posed, updates.update_cycles)
    theta = state
    np.testing.assert_allclose(state.cycles.mean[:, 0], theta.parent, atol=1e-9)
    identity = np.eye(len(theta.parent))
    laplacian = 2 * identity - np.roll(identity, 1, axis=0) - np.roll(identity, -1, axis=0)
    covariance = np.linalg.inv(theta.smoothness * laplacian + theta.closeness * identity)
    np.testing.assert_allclose(state.cycles.variance[:, 0, 0], np.diagonal(covariance))
