"""Rotations as quaternions: those of scipy, and signs that stay."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from mocapbench.datasets.lafan1.unit_quaternions import (
    invert_quaternions,
    keep_signs,
    multiply_quaternions,
    place_joints,
    quaternions_of_angles,
    quaternions_of_vectors,
    rotate_vectors,
)

seeds = st.integers(0, 2**32 - 1)


def as_scipy(quaternions):
    return Rotation.from_quat(np.roll(quaternions, -1, axis=-1))


@given(seeds)
def test_products_and_rotations_are_those_of_scipy(seed):
    rng = np.random.default_rng(seed)
    vectors = rng.normal(size=(2, 5, 3))
    first, second = quaternions_of_vectors(vectors)
    expected = Rotation.from_rotvec(vectors[0]) * Rotation.from_rotvec(vectors[1])
    product = as_scipy(multiply_quaternions(first, second))
    np.testing.assert_allclose(product.as_matrix(), expected.as_matrix(), atol=1e-12)
    moved = rng.normal(size=(5, 3))
    np.testing.assert_allclose(rotate_vectors(first, moved), as_scipy(first).apply(moved))
    np.testing.assert_allclose(
        rotate_vectors(invert_quaternions(first), rotate_vectors(first, moved)), moved
    )


@pytest.mark.parametrize("order", ["ZYX", "XZY"])
def test_angles_are_applied_about_axes_that_turn_along(order):
    angles = np.random.default_rng(0).uniform(-180, 180, (6, 3))
    ours = as_scipy(quaternions_of_angles(angles, ["XYZ".index(axis) for axis in order]))
    expected = Rotation.from_euler(order, angles, degrees=True)
    np.testing.assert_allclose(ours.as_matrix(), expected.as_matrix(), atol=1e-12)


def test_no_rotation_is_the_first_number_alone():
    np.testing.assert_array_equal(quaternions_of_vectors(np.zeros(3)), [1, 0, 0, 0])


def test_signs_that_jump_are_put_right_and_others_stay():
    angles = np.linspace(0, 1000, 60)[:, None]
    smooth = quaternions_of_angles(angles, [2])
    signs = np.where(np.random.default_rng(1).random(60) < 0.5, -1.0, 1.0)[:, None]
    signs[0] = 1.0
    np.testing.assert_array_equal(keep_signs(smooth * signs), smooth)
    np.testing.assert_array_equal(keep_signs(-smooth), -smooth)


def test_a_joint_lies_where_the_rotation_of_its_parent_puts_it():
    """The root turns by 90° about z, its child by another 90°; the last joint has its own."""
    quarter = quaternions_of_angles(np.array([90.0]), [2])
    rotations = np.stack([quarter, quarter, quarter])
    offsets = np.array([[7.0, 7.0, 7.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    turned, placed = place_joints(np.array([10.0, 0.0, 0.0]), rotations, offsets, (-1, 0, 1))
    np.testing.assert_allclose(placed, [[10, 0, 0], [10, 1, 0], [10, -1, 0]], atol=1e-12)
    thrice = quaternions_of_angles(np.array([270.0]), [2])
    np.testing.assert_allclose(turned[2], thrice, atol=1e-12)
