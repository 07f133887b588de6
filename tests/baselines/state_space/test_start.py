"""The states that EM starts from."""

import warnings

import numpy as np
import pytest

from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.baselines.state_space.expectation_maximisation import (
    initial_states,
    start_parameters,
)
from mocapbench.baselines.state_space.linear_gaussian import PRIORS

ANGLE = 2 * np.pi * np.arange(60) / 12


def test_states_are_white():
    rng = np.random.default_rng(0)
    data = Sequences.of([rng.normal(size=(20, 4)), rng.normal(size=(9, 4))])
    states = initial_states(data, 3)
    assert np.all(states[1, 9:] == 0.0)
    stacked = states[data.frames]
    np.testing.assert_allclose(stacked.mean(axis=0), 0.0, atol=1e-12)
    np.testing.assert_allclose(stacked.T @ stacked / len(stacked), np.eye(3), atol=1e-10)


def test_there_can_be_more_states_than_channels():
    """One channel of an oscillation has two states: it recurs after rising and after falling."""
    data = Sequences.of([np.sin(ANGLE)[:, None]])
    parameters = start_parameters(initial_states(data, 2), data, PRIORS)
    turn = np.abs(np.angle(np.linalg.eigvals(parameters.transition)))
    np.testing.assert_allclose(turn, 2 * np.pi / 12, rtol=0.05)


def test_more_states_than_dimensions_are_reduced_with_a_warning():
    data = Sequences.of([np.arange(3.0)[:, None] ** 2])
    with pytest.warns(UserWarning, match="at least n_states=9 dimensions, got 2: .* has 2 states"):
        assert initial_states(data, 9).shape == (1, 3, 2)


def test_data_without_any_dimension_have_one_state():
    with pytest.warns(UserWarning, match="got 0: the model has 1 states"):
        states = initial_states(Sequences.of([np.zeros((1, 2))]), 2)
    np.testing.assert_array_equal(states, np.zeros((1, 1, 1)))


def test_enough_dimensions_raise_no_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        initial_states(Sequences.of([np.random.default_rng(0).normal(size=(30, 3))]), 15)


def test_states_do_not_depend_on_the_signs_of_eigenvectors(monkeypatch):
    data = Sequences.of([np.random.default_rng(0).normal(size=(30, 3))])
    states, eigh = initial_states(data, 4), np.linalg.eigh
    monkeypatch.setattr(np.linalg, "eigh", lambda matrix: (eigh(matrix)[0], -eigh(matrix)[1]))
    np.testing.assert_array_equal(initial_states(data, 4), states)
