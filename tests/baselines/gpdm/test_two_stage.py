"""Two-stage learning: Monte Carlo EM, and then the positions."""

import numpy as np
import pytest

from mocapbench.baselines.gpdm.hmc import HybridMonteCarlo
from mocapbench.baselines.gpdm.two_stage import TwoStage, optimise_latents

from .conftest import objective


@pytest.fixture
def learning():
    sampler = HybridMonteCarlo(n_samples=3, n_burn=1, n_leaps=3, step=3e-3)
    return TwoStage(sampler, n_rounds=1, n_alternations=1, n_steps=3, n_last=5)


def test_learning_lowers_the_objective(learning, posterior, start):
    estimate = learning.learn(posterior, start, np.random.default_rng(0))
    assert objective(posterior, estimate) < objective(posterior, start)


def test_learning_changes_every_unknown(learning, posterior, start):
    estimate = learning.learn(posterior, start, np.random.default_rng(0))
    for name in ("x", "alpha", "beta", "scales"):
        assert not np.allclose(getattr(estimate, name), getattr(start, name)), name


def test_two_stage_learning_is_seeded(learning, posterior, start):
    def learn(seed):
        return learning.learn(posterior, start, np.random.default_rng(seed)).x

    # NumPy's sums depend on where an array begins in memory, which sampling amplifies.
    np.testing.assert_allclose(learn(1), learn(1), rtol=1e-4)
    assert not np.allclose(learn(1), learn(2), rtol=1e-2)


def test_optimised_positions_lower_the_objective_and_keep_the_rest(posterior, start):
    ends = [optimise_latents(posterior, start, n_steps) for n_steps in (1, 3, 10)]
    values = [objective(posterior, end) for end in (start, *ends)]
    assert (np.diff(values) <= 1e-9).all()
    for name in ("alpha", "beta", "scales"):
        np.testing.assert_array_equal(getattr(ends[-1], name), getattr(start, name))
