"""The initial state of EM."""

import numpy as np
import pytest

from mocapbench.baselines.alignment.cycle_model import Hyperparameters
from mocapbench.baselines.alignment.cycle_start import first_cycle, start_em
from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.common.padded_sequences import Sequences


def test_a_line_is_resampled_to_a_line():
    frames = np.column_stack([np.arange(6.0), 2 * np.arange(6.0)])
    cycle = first_cycle(frames, 4, 8)
    np.testing.assert_allclose(cycle[:7, 0], 0.5 * np.arange(7))
    np.testing.assert_allclose(cycle[:, 1], 2 * cycle[:, 0])


def test_hidden_entries_are_bridged_and_hidden_channels_are_zero():
    frames = np.column_stack([np.arange(4.0), np.full(4, np.nan)])
    frames[1, 0] = np.nan
    cycle = first_cycle(frames, 4, 4)
    np.testing.assert_allclose(cycle, np.column_stack([np.arange(4.0), np.zeros(4)]))


def test_a_start_has_one_style_with_the_given_cycle_and_normalised_posteriors():
    rng = np.random.default_rng(0)
    sequences = Sequences.of([rng.normal(size=(n, 2)) for n in (6, 4)])
    parent = rng.normal(size=(7, 2))
    hyper = Hyperparameters(0.1, PRIORS["normalised"], closeness=0.1, smoothness=0.2)
    state = start_em(parent, sequences, hyper)
    assert (state.closeness, state.smoothness) == (0.1, 0.2)
    np.testing.assert_array_equal(state.cycles.mean[:, 0], parent)
    np.testing.assert_array_equal(state.labels, np.ones((2, 1)))
    np.testing.assert_allclose(state.jumps, np.full((2, 3), 1 / 3))
    occupancy = state.paths.occupancy.sum(axis=2)
    np.testing.assert_allclose(occupancy, sequences.frames.astype(float), atol=1e-12)
    variance = sequences.squares.sum(axis=0) / sequences.counts.sum(axis=0)
    np.testing.assert_allclose(state.precisions, 1 / variance[None])


def test_the_precision_of_a_still_channel_is_limited():
    sequences = Sequences.of([np.zeros((5, 1))])
    hyper = Hyperparameters(0.1, PRIORS["normalised"], max_precision=100.0, max_jump=2)
    state = start_em(np.zeros((5, 1)), sequences, hyper)
    assert state.precisions.item() == pytest.approx(100.0)
