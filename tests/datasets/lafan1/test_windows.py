"""Windows of takes: how many, where they lie, and which way they face."""

import numpy as np
import pytest

from mocapbench.datasets import Recording, Segment, Skeleton
from mocapbench.datasets.lafan1.unit_quaternions import (
    multiply_quaternions,
    quaternions_of_angles,
    quaternions_of_vectors,
    rotate_vectors,
)
from mocapbench.datasets.lafan1.windows import N_PAST, cut_windows, split_takes

BODY = Skeleton(
    "body",
    2.54,
    tuple(
        Segment(name, parent, (0.0, 1.0, 0.0), 1.0, (0.0, 0.0, 0.0), "XYZ", ())
        for name, parent in (("hip", ""), ("knee", "hip"))
    ),
)


def draw_take(n_frames, seed=0):
    rng = np.random.default_rng(seed)
    return rng.normal(size=(n_frames, 3)), quaternions_of_vectors(rng.normal(size=(n_frames, 4, 3)))


@pytest.mark.parametrize(("n_frames", "n_windows"), [(64, 0), (65, 0), (66, 1), (105, 1), (106, 2)])
def test_a_window_that_would_end_with_the_take_is_left_out(n_frames, n_windows):
    root, rotations = cut_windows([draw_take(n_frames), draw_take(70)], 65, 40)
    assert root.shape == (n_windows + 1, 65, 3)
    assert rotations.shape == (n_windows + 1, 65, 4, 4)


def test_windows_are_centred_on_the_floor_and_face_x_at_the_last_frame_before_the_gap():
    take = draw_take(200)
    root, rotations = cut_windows([take], 65, 40)
    forward = rotate_vectors(rotations[:, N_PAST - 1, 0], np.array([0.0, 1.0, 0.0]))
    np.testing.assert_allclose(forward[:, 2], 0.0, atol=1e-12)
    assert (forward[:, 0] > 0).all()
    np.testing.assert_allclose(root.mean(axis=1)[:, [0, 2]], 0.0, atol=1e-12)
    np.testing.assert_allclose(root[1, :, 1], take[0][40:105, 1])
    np.testing.assert_array_equal(rotations[1, :, 1:], take[1][40:105, 1:])


def test_where_a_take_stands_and_faces_does_not_matter():
    root, rotations = draw_take(150)
    turn = quaternions_of_angles(np.array([70.0]), [1])
    turned = rotations.copy()
    turned[:, 0] = multiply_quaternions(turn, rotations[:, 0])
    moved = rotate_vectors(turn, root) + np.array([5.0, 0.0, -3.0])
    one, two = cut_windows([(root, rotations)], 65, 40), cut_windows([(moved, turned)], 65, 40)
    np.testing.assert_allclose(one[0], two[0], atol=1e-9)
    np.testing.assert_allclose(np.abs(one[1]), np.abs(two[1]), atol=1e-9)


def test_takes_are_told_apart_by_pauses_and_angles_taken_in_their_order():
    times = np.concatenate([np.arange(5), np.arange(5, 9) + 30]) / 30
    channels = [
        *(f"hip.t{axis}" for axis in "xyz"),
        *(f"{j}.r{a}" for j in ("hip", "knee") for a in "zyx"),
    ]
    values = np.random.default_rng(0).uniform(-30, 30, (9, 9))
    recording = Recording("takes", times, values, channels, ("",) * 9)
    one, two = split_takes(recording, BODY)
    np.testing.assert_array_equal(np.concatenate([one[0], two[0]]), values[:, :3])
    assert [len(take[1]) for take in (one, two)] == [5, 4]
    knee = quaternions_of_angles(values[5:, 6:], [2, 1, 0])
    np.testing.assert_allclose(np.abs((knee * two[1][:, 1]).sum(axis=-1)), 1.0)
