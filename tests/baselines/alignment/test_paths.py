"""Sufficient statistics of the frames, and states of some of the sequences."""

import numpy as np
import pytest

from mocapbench.baselines.alignment.cycle_model import Paths


@pytest.fixture
def posed(pose):
    return pose(4, n_styles=2)


def test_evidence_sums_frames_weighted_by_their_states(posed):
    sequences, occupancy = posed.sequences, posed.state.paths.occupancy
    posterior = (occupancy, np.zeros((4, 2)), np.zeros(4))
    evidence = Paths.of(sequences, posterior)
    np.testing.assert_allclose(
        evidence.counts, np.einsum("knm,knf->kmf", occupancy, sequences.visible)
    )
    np.testing.assert_allclose(
        evidence.sums, np.einsum("knm,knf->kmf", occupancy, sequences.values)
    )
    np.testing.assert_allclose(evidence.counts.sum(axis=1), sequences.counts)


def test_evidence_of_styles_is_weighted_by_the_labels(posed):
    labels, evidence = posed.state.labels, posed.state.paths
    counts, sums = evidence.by_style(labels)
    np.testing.assert_allclose(counts, np.einsum("kc,kmf->mcf", labels, evidence.counts))
    np.testing.assert_allclose(sums, np.einsum("kc,kmf->mcf", labels, evidence.sums))


def test_the_rows_of_a_state_are_those_of_its_sequences(posed):
    parts = [posed.state.rows(np.array(index)) for index in ([0, 1], [2, 3])]
    for name in ("occupancy", "n_jumps", "entropy", "counts", "sums"):
        whole = getattr(posed.state.paths, name)
        np.testing.assert_array_equal(getattr(parts[1].paths, name), whole[2:])
    np.testing.assert_array_equal(parts[0].labels, posed.state.labels[:2])
