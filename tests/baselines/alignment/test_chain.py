import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mocapbench.baselines.alignment.chain import forward_backward, viterbi

N_STATES = 5


def _problem(seed, lengths=(4, 1, 3), n_states=N_STATES, max_jump=2, sd=5.0):
    rng = np.random.default_rng(seed)
    frames = np.arange(max(lengths)) < np.array(lengths)[:, None]
    emission = rng.normal(0.0, sd, (*frames.shape, n_states)) * frames[:, :, None]
    return emission, rng.dirichlet(np.ones(max_jump), len(lengths)), frames


def _paths(emission, jumps):
    """Every path of one sequence with its log-probability, evidence included."""
    n_states, max_jump = emission.shape[1], len(jumps)
    for path in itertools.product(range(n_states), repeat=len(emission)):
        steps = np.diff(path) % n_states
        if ((steps >= 1) & (steps <= max_jump)).all():
            yield path, np.log(jumps)[steps - 1].sum() + emission[range(len(path)), path].sum()


@given(seed=st.integers(0, 2**32 - 1), sd=st.sampled_from([0.1, 5.0, 500.0]))
def test_posterior_and_best_path_are_those_of_all_paths(seed, sd):
    emission, jumps, frames = _problem(seed, sd=sd)
    occupancies, n_jumps, entropies = forward_backward(emission, jumps, frames)
    best = viterbi(emission, jumps, frames)
    for k, length in enumerate(frames.sum(axis=1)):
        paths, scores = zip(*_paths(emission[k, :length], jumps[k]), strict=True)
        scores = np.array(scores)
        weights = np.exp(scores - np.logaddexp.reduce(scores))
        occupancy, counts = np.zeros((emission.shape[1], N_STATES)), np.zeros(jumps.shape[1])
        for path, weight in zip(paths, weights, strict=True):
            occupancy[range(length), path] += weight
            np.add.at(counts, np.diff(path) % N_STATES - 1, weight)
        np.testing.assert_allclose(occupancies[k], occupancy, atol=1e-9)
        np.testing.assert_allclose(n_jumps[k], counts, atol=1e-9)
        entropy = -(weights * np.log(np.where(weights > 0, weights, 1.0))).sum()
        assert entropies[k] == pytest.approx(entropy, abs=1e-9)
        assert tuple(best[k]) == paths[int(scores.argmax())]


def test_a_sequence_does_not_see_the_others():
    emission, jumps, frames = _problem(1)
    together, n_jumps, _ = forward_backward(emission, jumps, frames)
    for k, length in enumerate(frames.sum(axis=1)):
        alone, n_alone, _ = forward_backward(
            emission[[k], :length], jumps[[k]], np.ones((1, length), dtype=bool)
        )
        np.testing.assert_allclose(together[k, :length], alone[0], rtol=1e-12, atol=1e-300)
        np.testing.assert_allclose(n_jumps[k], n_alone[0], rtol=1e-12)


def test_moving_the_states_round_moves_the_posterior():
    emission, jumps, frames = _problem(2, lengths=(6, 5), n_states=9, max_jump=3)
    plain, _, entropy = forward_backward(emission, jumps, frames)
    rolled, _, same = forward_backward(np.roll(emission, 4, axis=2), jumps, frames)
    np.testing.assert_allclose(rolled, np.roll(plain, 4, axis=2), rtol=1e-10)
    np.testing.assert_allclose(same, entropy, rtol=1e-10)


def test_evidence_beyond_the_range_of_a_double_is_weighed():
    emission = np.zeros((1, 3, 6))
    emission[0, 0, 0] = 4000.0
    emission[0, 2, 0] = 5000.0
    frames = np.ones((1, 3), dtype=bool)
    occupancy, _, _ = forward_backward(emission, np.full((1, 2), 0.5), frames)
    assert occupancy[0, 2, 0] == pytest.approx(1.0)
    assert occupancy[0, 0, 0] == 0.0
    np.testing.assert_allclose(occupancy.sum(axis=2), 1.0)
