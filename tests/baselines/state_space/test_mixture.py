"""Classification EM: no step lowers its objective, and every sequence is in its best component."""

import numpy as np
import pytest

from mocapbench.baselines.state_space.expectation_maximisation import initial_states
from mocapbench.baselines.state_space.kalman import filter_states
from mocapbench.baselines.state_space.linear_gaussian import PRIORS
from mocapbench.baselines.state_space.mixture import Mixture, classification_em, seed_mixture

SEEDS = np.array([0, 2, 3])


def mixture_of(problem, seeds=SEEDS):
    states = initial_states(problem.data, 2)
    return seed_mixture(states, problem.data, seeds, PRIORS)


@pytest.mark.filterwarnings("ignore:expected training data")
@pytest.mark.parametrize("seed", range(12))
def test_no_iteration_lowers_the_objective(pose, seed):
    problem = pose(seed, lengths=(6, 1, 9, 4, 7, 5), hidden=0.2)
    run = classification_em(mixture_of(problem), problem.data, PRIORS, max_iter=10, tol=-1e9)
    assert len(run.objectives) == 11
    assert np.diff(run.objectives).min() >= -1e-9 * np.abs(run.objectives).max()


def test_every_sequence_is_where_it_is_most_probable(pose):
    problem = pose(0, lengths=(6, 3, 9, 4), hidden=0.2)
    mixture = mixture_of(problem).improve(problem.data, PRIORS)
    evidence = np.column_stack(
        [filter_states(component, problem.data)[-1] for component in mixture.components]
    )
    joint = evidence + np.log(mixture.weights)
    np.testing.assert_array_equal(mixture.labels, joint.argmax(axis=1))
    prior = sum(component.log_prior(PRIORS) for component in mixture.components)
    expected = joint.max(axis=1).sum() + np.log(mixture.weights).sum() + prior
    assert mixture.objective == pytest.approx(expected)


def test_a_component_without_members_stays_as_it_is(pose):
    problem = pose(1, lengths=(6, 5, 4), hidden=0.0)
    mixture = mixture_of(problem, np.array([0, 1]))
    emptied = Mixture(mixture.components, mixture.weights, np.zeros(3, dtype=int), -np.inf)
    improved = emptied.improve(problem.data, PRIORS)
    assert improved.components[1] is mixture.components[1]
    np.testing.assert_allclose(improved.weights, [0.8, 0.2])


def test_it_stops_when_an_iteration_gains_too_little(pose):
    problem = pose(2, lengths=(6, 5, 8, 7), hidden=0.1)
    run = classification_em(mixture_of(problem), problem.data, PRIORS, max_iter=99, tol=0.01)
    gains = np.diff(run.objectives) / problem.data.counts.sum()
    assert run.converged
    assert gains[-1] < 0.01 <= gains[:-1].min()
