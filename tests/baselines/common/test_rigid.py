import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mocapbench.baselines.common.rigid import (
    find_rotations,
    least_rotations,
    spans_a_body,
    steadiness,
)


def test_rotations_are_those_that_turned_the_markers():
    before = np.random.default_rng(0).normal(size=(5, 3))
    before -= before.mean(axis=0)
    turns = Rotation.random(7, random_state=0)
    after = np.stack([turns.apply(marker) for marker in before], axis=1)
    found = find_rotations(before, after, np.ones(5))
    np.testing.assert_allclose(found, turns.as_matrix().transpose(0, 2, 1), atol=1e-12)


def test_a_mirror_image_is_not_taken_for_a_rotation():
    before = np.random.default_rng(1).normal(size=(6, 3))
    found = find_rotations(before, (before * [1.0, 1.0, -1.0])[None], np.ones(6))
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


def test_a_marker_seen_once_in_each_recording_tells_nothing_of_its_steadiness():
    first = np.random.default_rng(3).normal(size=(6, 3, 3))
    second = np.random.default_rng(4).normal(size=(6, 3, 3))
    first[1:, 1], second[:5, 1] = np.nan, np.nan
    np.testing.assert_allclose(steadiness([first, second], 0), [0.0, 0.0, 1.0])


def test_a_recording_that_shows_a_distance_once_changes_no_steadiness():
    places = np.random.default_rng(5).normal(size=(6, 3, 3))
    once = np.full((4, 3, 3), np.nan)
    once[0] = np.random.default_rng(6).normal(size=(3, 3))
    np.testing.assert_allclose(steadiness([places, once], 0), steadiness([places], 0))


def line(seed, off, noise=0.0, n_frames=30):
    """Return three markers in successive frames (T, 3, 3), one of them beside the line."""
    rng = np.random.default_rng(seed)
    shape = np.array([[0.0, 0.0, -10.0], [off, 0.0, 1.0], [0.0, 0.0, 9.0]])
    shapes = (
        shape + rng.normal(0.0, noise, (n_frames, 3, 3)) if noise else np.tile(shape, (9, 1, 1))
    )
    return shapes - shapes.mean(axis=1, keepdims=True)


@pytest.mark.parametrize("scale", [1.0, 1e3])
@pytest.mark.parametrize("noise", [0.0, 0.01])
def test_only_markers_clearly_beside_a_line_span_a_body(noise, scale):
    shares = np.full(3, 1.0 / 3.0)
    spans = [spans_a_body(scale * line(0, off, noise), shares) for off in (0.0, noise / 3.0, 1.0)]
    assert spans == [False, False, True]


def test_markers_in_one_place_span_no_body_and_turn_nowhere():
    place, shares = np.zeros((4, 3, 3)), np.full(3, 1.0 / 3.0)
    assert not spans_a_body(place, shares)
    turns = least_rotations(place[0], place, shares)
    np.testing.assert_array_equal(turns, np.tile(np.eye(3), (4, 1, 1)))


def test_the_least_rotation_takes_a_line_along_and_does_not_turn_about_it():
    before, shares = line(0, 0.0)[0], np.full(3, 1.0 / 3.0)
    across = Rotation.from_rotvec(np.outer(np.linspace(-2.0, 2.0, 9), [0.6, 0.8, 0.0]))
    after = np.stack([across.apply(marker) for marker in before], axis=1)
    found = least_rotations(before, after, shares)
    np.testing.assert_allclose(found, across.as_matrix().transpose(0, 2, 1), atol=1e-12)
