import numpy as np
import pytest

from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.baselines.state_space.expectation_maximisation import (
    initial_states,
    show_noise,
    start_parameters,
)
from mocapbench.baselines.state_space.kalman import smooth_states
from mocapbench.baselines.state_space.linear_gaussian import PRIORS


def sines(noise, n_frames=600):
    """Return observations of six channels of two frequencies, with noise, some of them hidden."""
    rng, angles = np.random.default_rng(0), np.arange(n_frames) / 10
    waves = [np.sin(angles + k) + 0.3 * np.sin(2 * angles + 2 * k) for k in range(6)]
    values = np.stack(waves, axis=1) + rng.normal(0.0, noise, (n_frames, 6))
    values[100:130, 0] = np.nan
    return Sequences.of([values])


@pytest.mark.parametrize("noise", [0.05, 0.1, 0.3])
def test_it_is_the_noise_that_data_have(noise):
    data = sines(noise)
    learnt = start_parameters(initial_states(data, 4), data, PRIORS)
    shown = show_noise(learnt, data)
    np.testing.assert_allclose(np.sqrt(shown.noise), noise, rtol=0.2)
    assert (learnt.noise > shown.noise).all()


@pytest.mark.parametrize("seed", range(5))
def test_all_else_is_kept_and_the_likelihood_rises(pose, seed):
    problem = pose(seed, lengths=(40, 30))
    shown = show_noise(problem.parameters, problem.data)
    np.testing.assert_array_equal(shown.loadings, problem.parameters.loadings)
    np.testing.assert_array_equal(shown.offset, problem.parameters.offset)
    assert shown.transition is problem.parameters.transition
    before, after = (
        smooth_states(each, problem.data).log_likelihood.sum()
        for each in (problem.parameters, shown)
    )
    assert after > before
