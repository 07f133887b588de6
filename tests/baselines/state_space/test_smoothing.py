"""Smoothed moments are those of the joint Gaussian of states and visible entries."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mocapbench.baselines.state_space.kalman import smooth_states

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
def test_smoothed_moments_are_those_of_the_joint_gaussian(pose, sizes):
    problem = pose(**sizes)
    posterior = smooth_states(problem.parameters, problem.data)
    for k, exact in enumerate(problem.exact()):
        n = np.arange(len(exact.mean))
        close = {"rtol": 1e-7, "atol": 1e-8}
        np.testing.assert_allclose(posterior.mean[k, n], exact.mean, **close)
        np.testing.assert_allclose(posterior.covariance[k, n], exact.covariance[n, :, n], **close)
        lagged = exact.covariance[n[1:], :, n[:-1]]
        np.testing.assert_allclose(posterior.lagged[k, n[:-1]], lagged, **close)
