"""Rotations as unit quaternions (w, x, y, z), whose signs are kept as they come.

q and −q are the same rotation. Errors of LaFAN1 compare the four numbers, so that signs must not
change within a recording, and a library that may choose them does not serve.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce

import numpy as np

from mocapbench.basics.arrays import Array

__all__ = [
    "invert_quaternions",
    "keep_signs",
    "multiply_quaternions",
    "place_joints",
    "quaternions_of_angles",
    "quaternions_of_vectors",
    "rotate_vectors",
]


def multiply_quaternions(first: Array, second: Array) -> Array:
    """Return the products (..., 4): the rotation by ``second``, and then by ``first``."""
    a, b = first[..., :1], second[..., :1]
    u, v = first[..., 1:], second[..., 1:]
    scalar = a * b - (u * v).sum(axis=-1, keepdims=True)
    return np.concatenate([scalar, a * v + b * u + np.cross(u, v)], axis=-1)


def invert_quaternions(quaternions: Array) -> Array:
    """Return the inverse rotations (..., 4)."""
    return quaternions * [1.0, -1.0, -1.0, -1.0]


def rotate_vectors(quaternions: Array, vectors: Array) -> Array:
    """Return vectors (..., 3) rotated by quaternions (..., 4)."""
    w, u = quaternions[..., :1], quaternions[..., 1:]
    across = 2.0 * np.cross(u, vectors)
    return np.asarray(vectors + w * across + np.cross(u, across))


def quaternions_of_vectors(vectors: Array) -> Array:
    """Return the rotations (..., 4) of rotation vectors (..., 3) in radians."""
    halves = np.linalg.norm(vectors, axis=-1, keepdims=True) / 2.0
    # sin(h)/(2 h), which is 1/2 where nothing is turned
    return np.concatenate([np.cos(halves), 0.5 * np.sinc(halves / np.pi) * vectors], axis=-1)


def quaternions_of_angles(degrees: Array, axes: Sequence[int]) -> Array:
    """Return the rotations (..., 4) of angles (..., K) about axes 0 to 2 that turn along."""
    vectors = np.deg2rad(degrees)[..., np.newaxis] * np.eye(3)[[*axes]]
    turns = quaternions_of_vectors(vectors)
    return reduce(multiply_quaternions, np.moveaxis(turns, -2, 0))


def keep_signs(quaternions: Array) -> Array:
    """Return quaternions (N, ..., 4) of which each is the nearer of q and −q to the one before."""
    products = (quaternions[1:] * quaternions[:-1]).sum(axis=-1)
    signs = np.cumprod(np.where(products < 0.0, -1.0, 1.0), axis=0)
    return np.concatenate([quaternions[:1], quaternions[1:] * signs[..., np.newaxis]])


def place_joints(
    root: Array, rotations: Array, offsets: Array, parents: Sequence[int]
) -> tuple[Array, Array]:
    """Return the rotations in space (..., J, 4) of all joints, and their places (..., J, 3).

    Parameters
    ----------
    root : ndarray of shape (..., 3)
        The root's place.
    rotations : ndarray of shape (..., J, 4)
        Of each joint within its parent.
    offsets : ndarray of shape (J, 3)
        From the parent, as in the rest pose.
    parents : sequence of J int
        -1 for the root, which is first; every parent is before its children.
    """
    turned, placed = [rotations[..., 0, :]], [root]
    for joint, parent in enumerate(parents[1:], start=1):
        placed.append(placed[parent] + rotate_vectors(turned[parent], offsets[joint]))
        turned.append(multiply_quaternions(turned[parent], rotations[..., joint, :]))
    return np.stack(turned, axis=-2), np.stack(placed, axis=-2)
