r"""A body that moves with markers, from which others are seen.

In every frame it is where the rotation :math:`R_t` (row vectors) and the centre :math:`c_t` fit
its mean shape best to the markers :math:`p_k(t)` that hold it, with weights :math:`w_k`. What is
at x in the room is at :math:`(x - c_t) R_t^\top` as seen from it. Markers on a line do not fix the
rotation about it; the body then follows the line, and does not rotate about it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Self

import numpy as np

from mocapbench.baselines.common.rigid import find_rotations, least_rotations, spans_a_body
from mocapbench.basics.arrays import Array

__all__ = ["MarkerBody", "to_body", "to_room"]


_ROUNDS = 3
"""Times that the mean shape is fitted anew; it hardly moves after the first."""


class MarkerBody:
    """A shape that markers hold.

    Parameters
    ----------
    shape : ndarray of shape (K, 3)
        Of at least three markers, the weighted mean at the origin.
    weights : ndarray of shape (K,)
        Not negative; their sum is 1.
    rotate : callable
        Returns the rotations from the shape to markers, as `find_rotations` does.
    """

    def __init__(
        self, shape: Array, weights: Array, rotate: Callable[[Array, Array, Array], Array]
    ) -> None:
        self.shape: Array = shape
        self.weights: Array = weights
        self.rotate: Callable[[Array, Array, Array], Array] = rotate

    @classmethod
    def fit(cls, places: Array, weights: Array) -> Self:
        """Fit the shape to markers (T, K, 3) in the room; weights (K,) are not negative."""
        around = places[len(places) // 2]
        weights = weights / weights.sum()
        body = cls(around - weights @ around, weights, find_rotations)
        for _ in range(_ROUNDS):
            *_, shapes = body.see(places)
            body = cls(shapes.mean(axis=0), weights, find_rotations)
        fixed = spans_a_body(shapes, weights)
        return body if fixed else cls(body.shape, weights, least_rotations)

    def see(self, places: Array) -> tuple[Array, Array, Array]:
        """Find the body in frames in which markers are at ``places`` (T, K, 3).

        Returns
        -------
        rotations : ndarray of shape (T, 3, 3)
            From the body to the room, of row vectors.
        centres : ndarray of shape (T, 3)
            The weighted means of the markers.
        shapes : ndarray of shape (T, K, 3)
            The markers, as seen from the body.
        """
        centres = np.einsum("k,tki->ti", self.weights, places)
        around = places - centres[:, None]
        rotations = self.rotate(self.shape, around, self.weights)
        return rotations, centres, np.einsum("tkj,tij->tki", around, rotations)


def to_body(places: Array, rotations: Array, centres: Array) -> Array:
    """Return a marker (T, 3) of the room as seen from the body."""
    return np.asarray(np.einsum("tj,tij->ti", places - centres, rotations))


def to_room(seen: Array, rotations: Array, centres: Array) -> Array:
    """Return a marker (T, 3) as seen from the body in the room."""
    return np.asarray(np.einsum("ti,tij->tj", seen, rotations) + centres)
