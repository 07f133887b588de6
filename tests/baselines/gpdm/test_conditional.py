"""The density of a further sequence, and its optimisation."""

import numpy as np
import pytest


@pytest.fixture
def query(conditional):
    return (conditional.poses[:7], ~np.isin(np.arange(7), [3, 4]))


def test_optimisation_never_raises_the_objective(conditional, query):
    x = np.random.default_rng(0).standard_normal((7, 2))
    ends = [conditional.optimise(x, query, n_steps) for n_steps in (1, 3, 10, 30)]
    values = [conditional.negative_log_density(end, query)[0] for end in (x, *ends)]
    assert (np.diff(values) <= 1e-9).all()
    assert values[-1] < values[0]


def test_hidden_poses_do_not_count(conditional, query):
    poses = query[0].copy()
    poses[~query[1]] = 1e3
    x = conditional.x[:7]
    expected = conditional.negative_log_density(x, query)[0]
    changed = conditional.negative_log_density(x, (poses, query[1]))[0]
    assert changed == pytest.approx(expected)


def test_predecessors_stay_within_their_sequence(conditional):
    """The order is two; the sequences have seven and five frames."""
    before = conditional.predecessors()
    np.testing.assert_array_equal(before[:, 0], conditional.x)
    np.testing.assert_array_equal(before[1:7, 1], conditional.x[:6])
    np.testing.assert_array_equal(before[8:, 1], conditional.x[7:11])
    np.testing.assert_array_equal(before[[0, 7], 1], conditional.x[[0, 7]])
