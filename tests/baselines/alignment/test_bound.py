"""The bound never decreases: what proves the updates right."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import multivariate_normal

from mocapbench.baselines.alignment import updates
from mocapbench.baselines.alignment.cycle_model import Hyperparameters, lower_bound
from mocapbench.baselines.alignment.cycle_start import start_em
from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.alignment.updates import expectation_maximisation, update_paths
from mocapbench.baselines.common.padded_sequences import Sequences

E_STEP = (updates.update_cycles, updates.update_labels, updates.update_paths)
M_STEP = (
    updates.update_parent,
    updates.update_closeness,
    updates.update_smoothness,
    updates.update_precisions,
    updates.update_weights,
    updates.update_jumps,
)
UPDATES = (*E_STEP, *M_STEP)
PROBLEMS = {
    "seed": st.integers(0, 2**32 - 1),
    "n_styles": st.integers(1, 4),
    "n_states": st.integers(5, 12),
    "max_jump": st.integers(1, 3),
    "prior": st.sampled_from(sorted(PRIORS)),
    "eta": st.sampled_from([1e-3, 0.1, 2.0]),
    "hidden": st.sampled_from([0.0, 0.3, 0.8]),
}


def _slack(value):
    return 1e-9 * (1.0 + abs(value))


@given(order=st.lists(st.sampled_from(UPDATES), min_size=8, max_size=12), **PROBLEMS)
def test_no_update_lowers_the_bound_in_any_order(pose, order, **problem):
    posed = pose(**problem)
    state = posed.state
    value = lower_bound(state, posed.sequences, posed.hyper)
    for update in order:
        state = update(state, posed.sequences, posed.hyper)
        after = lower_bound(state, posed.sequences, posed.hyper)
        assert after >= value - _slack(value), update.__name__
        value = after


@settings(max_examples=30)
@given(n_inner=st.integers(1, 3), **PROBLEMS)
def test_em_never_lowers_the_bound(pose, n_inner, **problem):
    posed = pose(**problem)
    run = expectation_maximisation(
        posed.state,
        posed.sequences,
        replace(posed.hyper, n_inner=n_inner, tol=0.0),
        e_step=E_STEP,
        m_step=M_STEP,
        max_iter=12,
    )
    bounds = np.array([lower_bound(posed.state, posed.sequences, posed.hyper), *run.objectives])
    assert (np.diff(bounds) >= -_slack(bounds[1:])).all()


@pytest.mark.parametrize("prior", ["normalised", "centred"])
def test_with_nothing_visible_the_bound_is_the_prior_of_the_parameters(pose, prior):
    posed = pose(3, hidden=1.1, prior=prior)
    state = posed.state
    for update in E_STEP * 20:
        state = update(state, posed.sequences, posed.hyper)
    theta = state
    penalty = np.log(theta.weights).sum() + np.log(theta.jumps).sum()
    penalty -= ((theta.parent - np.roll(theta.parent, 1, axis=0)) ** 2).sum()
    expected = 0.1 * penalty + len(theta.weights) * _prior_of_parent(theta, prior)
    assert lower_bound(state, posed.sequences, posed.hyper) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("prior", ["normalised", "centred"])
@pytest.mark.parametrize(("separation", "slack"), [(1.0, np.inf), (30.0, 1e-6)])
def test_the_bound_is_below_the_evidence_and_tight_where_the_posterior_factorises(
    separation, slack, prior
):
    sequences, state = _walk_round_a_ring(separation)
    hyper = Hyperparameters(0.0, PRIORS[prior], 1e6)
    for update in E_STEP * 50:
        state = update(state, sequences, hyper)
    theta = state
    evidence = _log_evidence(sequences, theta, prior) + _prior_of_parent(theta, prior)
    assert evidence - slack <= lower_bound(state, sequences, hyper) <= evidence + 1e-6


def _walk_round_a_ring(separation):
    """Two short sequences, some entries hidden, about well separated states of one cycle."""
    rng = np.random.default_rng(0)
    parent = separation * rng.permuted(np.arange(10.0).reshape(5, 2), axis=0)
    arrays = [parent[path] + rng.normal(size=(len(path), 2)) for path in ([0, 2, 3], [3, 4])]
    arrays[0][1, 0] = np.nan
    sequences = Sequences.of(arrays)
    hyper = Hyperparameters(0.1, PRIORS["normalised"], smoothness=0.5, max_jump=2)
    state = start_em(parent, sequences, hyper)
    sharp = replace(state, precisions=np.array([[1.5, 0.7]]))
    return sequences, update_paths(sharp, sequences, hyper)


def _log_evidence(sequences, theta, prior):
    """log p(X | θ) of one style, summed over all pairs of paths, cycles integrated out."""
    centre, prior = _centre(theta, prior), np.linalg.inv(_prior_precision(theta))
    seen = sequences.visible[sequences.frames].astype(bool)
    values = sequences.values[sequences.frames]
    terms = []
    for paths in itertools.product(*map(_paths, sequences.lengths, theta.jumps)):
        states = np.concatenate([path for path, _ in paths])
        term = sum(weight for _, weight in paths)
        for f, noise in enumerate(1.0 / theta.precisions[0]):
            at = states[seen[:, f]]
            covariance = prior[np.ix_(at, at)] + noise * np.eye(len(at))
            term += multivariate_normal(centre[at, f], covariance).logpdf(values[seen[:, f], f])
        terms.append(term)
    return np.logaddexp.reduce(terms)


def _paths(length, jumps, n_states=5):
    """Every path with its prior log-probability."""
    for first, *steps in itertools.product(
        range(n_states), *[range(1, len(jumps) + 1)] * (length - 1)
    ):
        path = np.cumsum([first, *steps]) % n_states
        yield path, np.log(jumps)[np.array(steps, dtype=int) - 1].sum() - np.log(n_states)


def _prior_precision(theta):
    identity = np.eye(len(theta.parent))
    laplacian = 2.0 * identity - np.roll(identity, 1, axis=0) - np.roll(identity, -1, axis=0)
    return theta.smoothness * laplacian + theta.closeness * identity


def _centre(theta, prior):
    """Mean of a cycle before any data: the parent, which HLM's steps make smoother."""
    smoothed = np.linalg.solve(_prior_precision(theta), theta.closeness * theta.parent)
    return {"normalised": smoothed, "centred": theta.parent}[prior]


def _prior_of_parent(theta, prior):
    """What completing the square in a cycle's prior leaves over: a rough parent is unlikely."""
    deviation = theta.parent - _centre(theta, prior)
    return -0.5 * theta.closeness * (theta.parent * deviation).sum()
