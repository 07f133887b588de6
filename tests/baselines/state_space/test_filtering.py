"""The likelihood is that of the joint Gaussian of all visible entries."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.baselines.state_space.kalman import filter_states, run_recurrence

SIZES = st.fixed_dictionaries(
    {
        "seed": st.integers(0, 10**6),
        "lengths": st.lists(st.integers(1, 6), min_size=1, max_size=4),
        "n_states": st.integers(1, 4),
        "n_channels": st.integers(1, 4),
        "hidden": st.sampled_from([0.0, 0.3, 0.8, 1.0]),
    }
)


@settings(max_examples=40, deadline=None)
@given(sizes=SIZES)
def test_the_likelihood_is_that_of_the_joint_gaussian(pose, sizes):
    problem = pose(**sizes)
    expected = [exact.log_likelihood for exact in problem.exact()]
    *_, found = filter_states(problem.parameters, problem.data)
    np.testing.assert_allclose(found, expected, rtol=1e-8, atol=1e-8)


def test_the_last_filtered_state_is_the_smoothed_one(pose):
    problem = pose(1)
    mean, covariance, _, _ = filter_states(problem.parameters, problem.data)
    for k, exact in enumerate(problem.exact()):
        last = len(exact.mean) - 1
        group = problem.data.groups[k]
        np.testing.assert_allclose(mean[k, last], exact.mean[last], atol=1e-10)
        np.testing.assert_allclose(
            covariance[group, last], exact.covariance[last, :, last], atol=1e-10
        )


def test_companions_do_not_change_a_likelihood(pose):
    problem = pose(2, lengths=(3, 7, 5, 5))
    alone = [
        filter_states(problem.parameters, Sequences.of([array]))[-1][0] for array in problem.arrays
    ]
    *_, together = filter_states(problem.parameters, problem.data)
    np.testing.assert_allclose(together, alone, rtol=1e-10)


def test_complete_sequences_share_covariances(pose):
    problem = pose(3, lengths=(3, 7, 5), hidden=0.0)
    assert filter_states(problem.parameters, problem.data)[1].shape[:2] == (1, 7)


def test_a_recurrence_starts_from_nothing():
    gains, shifts = np.full((3, 1, 1, 1), 2.0), np.ones((3, 1, 1))
    assert run_recurrence(gains, shifts).ravel() == pytest.approx([1.0, 3.0, 7.0])
