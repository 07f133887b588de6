"""Training recordings as the models take them."""

import numpy as np
import pytest
from samples import recording

from mocapbench.baselines.gpdm.sequences import TrainingSequences, whitened_components

VALUES = np.random.default_rng(0).normal(size=(9, 3))


def test_a_hidden_frame_splits_a_recording_into_stretches():
    values = VALUES.copy()
    values[4, 1] = np.nan
    sequences = TrainingSequences.of([recording("a", values)])
    assert sequences.lengths == (4, 4)
    complete = np.delete(VALUES, 4, axis=0)
    np.testing.assert_allclose(sequences.y + sequences.mean, complete)
    np.testing.assert_allclose(sequences.y.mean(axis=0), 0.0, atol=1e-12)


def test_the_order_of_recordings_does_not_matter():
    pair = [recording("a", VALUES[:4]), recording("b", VALUES[4:])]
    for sequences in (TrainingSequences.of(pair), TrainingSequences.of(pair[::-1])):
        assert sequences.lengths == (4, 5)
        np.testing.assert_allclose(sequences.y + sequences.mean, VALUES)


def test_constant_channels_are_left_out_with_a_warning():
    values = np.column_stack([VALUES, np.full(9, 7.0)])
    with pytest.warns(UserWarning, match="channels c3, which are constant"):
        sequences = TrainingSequences.of([recording("a", values)])
    assert sequences.moving.tolist() == [True, True, True, False]
    assert sequences.y.shape == (9, 3)
    assert sequences.mean[3] == 7.0


def test_without_a_moving_channel_or_two_frames_there_is_nothing_to_learn():
    with pytest.raises(ValueError, match="a channel that moves"):
        TrainingSequences.of([recording("a", np.ones((5, 2)))])
    with pytest.raises(ValueError, match="two consecutive frames"):
        TrainingSequences.of([recording("a", np.ones((1, 2)))])


def test_components_are_uncorrelated_with_unit_variance():
    y = VALUES - VALUES.mean(axis=0)
    components = whitened_components(y, 2)
    np.testing.assert_allclose(components.T @ components / len(y), np.eye(2), atol=1e-10)
    leading = np.linalg.svd(y)[2][:2]
    projected = y @ leading.T
    correlation = np.corrcoef(np.hstack([components, projected]).T)[:2, 2:]
    np.testing.assert_allclose(np.abs(correlation), np.eye(2), atol=1e-8)


def test_components_beyond_the_rank_are_left_out_with_a_warning():
    y = np.outer(np.arange(5.0) - 2.0, [1.0, 2.0])
    with pytest.warns(UserWarning, match="at least n_latent=2 dimensions, got 1"):
        assert whitened_components(y, 2).shape == (5, 1)
