"""EM never lowers the likelihood plus log-prior, and stops when it should."""

from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.state_space.expectation_maximisation import (
    expectation_maximisation,
    maximise_parameters,
)
from mocapbench.baselines.state_space.kalman import filter_states, smooth_states
from mocapbench.baselines.state_space.linear_gaussian import PRIORS

VAGUE = (0.1, 0.01, 1e-3)
STRONG = (20.0, 2.0, 5.0)

SIZES = st.fixed_dictionaries(
    {
        "seed": st.integers(0, 10**6),
        "lengths": st.lists(st.integers(1, 12), min_size=1, max_size=4),
        "n_states": st.integers(1, 4),
        "n_channels": st.integers(1, 4),
        "hidden": st.sampled_from([0.0, 0.3, 0.8]),
    }
)


@settings(max_examples=30, deadline=None)
@given(
    sizes=SIZES,
    priors=st.sampled_from([PRIORS, (VAGUE,) * 3, (STRONG,) * 3]),
)
def test_no_iteration_lowers_the_objective(pose, sizes, priors):
    problem = pose(**sizes)
    run = expectation_maximisation(problem.parameters, problem.data, priors, max_iter=8, tol=-1e9)
    objectives = np.array(run.objectives)
    assert len(objectives) == 9
    assert np.diff(objectives).min() >= -1e-9 * np.abs(objectives).max()


def test_the_objective_is_the_likelihood_with_the_prior(pose):
    problem = pose(4)
    run = expectation_maximisation(problem.parameters, problem.data, PRIORS, max_iter=1, tol=0.0)
    exact = sum(exact.log_likelihood for exact in problem.exact())
    assert run.objectives[0] == pytest.approx(exact + problem.parameters.log_prior(PRIORS))


def test_a_fixed_point_is_a_maximum_of_the_objective(pose):
    """After many iterations, no small step of a parameter raises the objective (a law of EM)."""
    problem = pose(5, lengths=(9, 8), n_states=1, n_channels=2)
    run = expectation_maximisation(
        problem.parameters, problem.data, PRIORS, max_iter=1000, tol=-1e9
    )

    def objective(parameters):
        value = filter_states(parameters, problem.data)[-1].sum()
        return value + parameters.log_prior(PRIORS)

    found = run.state[0]
    peak = objective(found)
    for field in fields(found):
        array = getattr(found, field.name)
        for index in np.ndindex(array.shape):
            for step in (-1e-3, 1e-3):
                array[index] += step
                assert objective(replace(found)) < peak  # a copy has no cached products
                array[index] -= step


def test_hidden_frames_at_the_end_change_nothing(pose):
    problem = pose(6, lengths=(5, 4), hidden=0.2)
    longer = [np.vstack([array, np.full((3, 2), np.nan)]) for array in problem.arrays]
    one = smooth_states(problem.parameters, problem.data)
    two = smooth_states(problem.parameters, type(problem.data).of(longer))
    np.testing.assert_allclose(one.log_likelihood, two.log_likelihood, rtol=1e-10)
    np.testing.assert_allclose(one.mean[0, :5], two.mean[0, :5], atol=1e-10)


def test_the_order_of_sequences_changes_nothing(pose):
    problem = pose(7, lengths=(5, 4, 6))
    reversed_ = type(problem.data).of(problem.arrays[::-1])
    one = maximise_parameters(smooth_states(problem.parameters, problem.data), problem.data, PRIORS)
    two = maximise_parameters(smooth_states(problem.parameters, reversed_), reversed_, PRIORS)
    for field in fields(one):
        a, b = getattr(one, field.name), getattr(two, field.name)
        np.testing.assert_allclose(a, b, atol=1e-10)


def test_it_stops_when_an_iteration_gains_too_little(pose):
    problem = pose(8, lengths=(9, 8))
    n_visible = problem.data.counts.sum()
    run = expectation_maximisation(problem.parameters, problem.data, PRIORS, max_iter=500, tol=1e-3)
    gains = np.diff(run.objectives) / n_visible
    assert run.converged
    assert gains[-1] < 1e-3 <= gains[:-1].min()
