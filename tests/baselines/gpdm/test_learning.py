"""The learning algorithms minimise the joint negative log-posterior."""

from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines.gpdm.learning import (
    Balanced,
    FixedDynamics,
    MaximumAPosteriori,
    with_best_scales,
)

from .conftest import DYNAMICS, objective, smooth_posterior

ALPHA = (0.009, 0.2, 0.001, 1e6)
ALGORITHMS = {
    "map": MaximumAPosteriori(5, 5),
    "balanced": Balanced(5, 5),
    "fixed dynamics": FixedDynamics(5, 5),
}


@pytest.mark.parametrize("name", ALGORITHMS)
def test_learning_lowers_the_objective(posterior, start, name):
    if name == "fixed dynamics":
        start = replace(start, alpha=np.log(ALPHA))
    estimate = ALGORITHMS[name].learn(posterior, start, np.random.default_rng(0))
    assert objective(posterior, estimate) < objective(posterior, start)


def test_no_round_raises_the_objective(posterior, start):
    rng = np.random.default_rng(0)
    ends = [MaximumAPosteriori(rounds, 3).learn(posterior, start, rng) for rounds in range(6)]
    values = [objective(posterior, end) for end in ends]
    assert (np.diff(values) <= 1e-9).all()


def test_the_best_scales_lower_the_objective(posterior, start):
    best = with_best_scales(posterior, start)
    assert objective(posterior, best) < objective(posterior, start)
    for factor in (0.99, 1.01):
        other = replace(best, scales=factor * best.scales)
        assert objective(posterior, best) < objective(posterior, other)


def test_only_the_balanced_model_weighs_the_dynamics():
    weights = {name: learning.weight(12, 3) for name, learning in ALGORITHMS.items()}
    assert weights.pop("balanced") == 4.0
    assert set(weights.values()) == {1.0}


def test_fixed_dynamics_stay_as_they_are(posterior, start):
    estimate = ALGORITHMS["fixed dynamics"].learn(posterior, start, np.random.default_rng(0))
    np.testing.assert_allclose(np.exp(estimate.alpha), ALPHA)


def test_fixed_dynamics_need_as_many_parameters(start):
    posterior, start = smooth_posterior(DYNAMICS["rbf"])
    with pytest.raises(ValueError, match="expected dynamics with 4 parameters"):
        ALGORITHMS["fixed dynamics"].learn(posterior, start, np.random.default_rng(0))
