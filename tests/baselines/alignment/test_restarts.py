"""EM from random starts."""

from dataclasses import replace

import numpy as np
import pytest

from mocapbench.baselines.alignment.cycle_model import Hyperparameters
from mocapbench.baselines.alignment.cycle_start import GROUPINGS
from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.alignment.restarts import (
    copy_style,
    random_cycle,
    random_start,
    run_from_random_start,
)
from mocapbench.baselines.common.padded_sequences import Sequences

HYPER = Hyperparameters(
    0.1,
    PRIORS["normalised"],
    closeness=0.1,
    smoothness=0.1,
    max_jump=2,
    n_styles=2,
    tol=1e-4,
)


@pytest.fixture
def sequences():
    rng = np.random.default_rng(0)
    waves = [np.sin(1.5 * np.arange(n)[:, None] + np.arange(2)) for n in (12, 9, 15, 10)]
    return Sequences.of([wave + 0.1 * rng.normal(size=wave.shape) for wave in waves])


def test_no_run_ever_lowers_the_bound(sequences):
    rng = np.random.default_rng(0)
    for _ in range(3):
        run = run_from_random_start(sequences, 8, HYPER, 4, rng)
        assert (np.diff(run.objectives) >= -1e-9 * np.abs(run.objectives[1:])).all()


@pytest.mark.parametrize("grouping", GROUPINGS)
def test_a_start_has_styles_that_are_all_in_use_with_one_cycle(sequences, grouping):
    hyper = replace(HYPER, grouping=grouping)
    state = random_start(sequences, 8, hyper, np.random.default_rng(0))
    assert (state.labels.sum(axis=0) >= 1).all()
    assert set(state.labels.ravel()) == {0.0, 1.0}
    assert state.cycles.mean.shape == (8, 2, 2)
    np.testing.assert_array_equal(state.cycles.mean[:, 0], state.cycles.mean[:, 1])


def test_it_copies_the_one_style(sequences):
    one = replace(HYPER, n_styles=1)
    state = random_start(sequences, 8, one, np.random.default_rng(0))
    labels = np.eye(3)[[0, 1, 2, 0]]
    copies = copy_style(state, labels)
    np.testing.assert_array_equal(copies.labels, labels)
    np.testing.assert_allclose(copies.weights, np.full(3, 1 / 3))
    for name in ("mean", "variance", "neighbour"):
        original = getattr(state.cycles, name)
        np.testing.assert_array_equal(getattr(copies.cycles, name), original.repeat(3, axis=1))


def test_a_first_cycle_is_that_of_a_sequence_that_is_long_enough():
    short, long = np.zeros((2, 1)), np.arange(4.0)[:, None]
    sequences = Sequences.of([short, long, np.full((9, 1), np.nan)])
    for seed in range(5):
        cycle = random_cycle(sequences, 8, np.random.default_rng(seed))
        np.testing.assert_allclose(cycle[:7, 0], 0.5 * np.arange(7))
