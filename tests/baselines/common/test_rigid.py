import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mocapbench.baselines.common.rigid import rotations, steadiness


def test_rotations_are_those_that_turned_the_markers():
    before = np.random.default_rng(0).normal(size=(5, 3))
    before -= before.mean(axis=0)
    turns = Rotation.random(7, random_state=0)
    after = np.stack([turns.apply(marker) for marker in before], axis=1)
    found = rotations(before, after, np.ones(5))
    np.testing.assert_allclose(found, turns.as_matrix().transpose(0, 2, 1), atol=1e-12)


def test_a_mirror_image_is_not_taken_for_a_rotation():
    before = np.random.default_rng(1).normal(size=(6, 3))
    found = rotations(before, (before * [1.0, 1.0, -1.0])[None], np.ones(6))
    assert np.linalg.det(found[0]) == pytest.approx(1.0)


def test_the_inverse_standard_deviation_of_distances_counts():
    far = np.array([1.0, 1.2, 0.8, 1.0])
    places = np.zeros((4, 3, 3))
    places[:, 1, 0], places[:, 2, 0] = far, 5.0 * far
    np.testing.assert_allclose(steadiness([places], 0), [0.0, 1.0, 0.2])


def test_distances_may_differ_between_recordings():
    near = np.zeros((4, 3, 3))
    near[:, 1, 0], near[:, 2, 1] = [1.0, 1.1, 1.0, 0.9], [1.0, 1.2, 1.0, 0.8]
    np.testing.assert_allclose(steadiness([near, 3.0 + 2.0 * near], 0), steadiness([near], 0))


def test_a_marker_that_is_never_seen_beside_another_does_not_count():
    places = np.random.default_rng(2).normal(size=(6, 3, 3))
    places[:3, 0], places[3:, 1] = np.nan, np.nan
    assert steadiness([places], 0)[1] == 0.0
