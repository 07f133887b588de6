r"""Markers as seen from a body that moves with some of them.

A body is in every frame where the rotation :math:`R_t` (row vectors) and the centre :math:`c_t` fit
its mean shape best to the markers :math:`p_k(t)` that hold it, with weights :math:`w_k`. What is at
x in the room is at :math:`(x - c_t) R_t^\top` as seen from it. Markers on a line do not tell how
the body turns about it; it then turns with the line, and not about it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.rigid import least_rotations, rotations, spans_a_body
from mocapbench.basics.arrays import Array

__all__ = ["LocalFrames"]


_ROUNDS = 3
"""Times that the mean shape is fitted anew; it hardly moves after the first."""


@dataclass(frozen=True, eq=False)
class LocalFrames:
    """Where a body is in T frames.

    Parameters
    ----------
    turns : ndarray of shape (T, 3, 3)
        Rotations from the body to the room, of row vectors.
    centres : ndarray of shape (T, 3)
        The weighted means of the markers.
    shapes : ndarray of shape (T, K, 3)
        The markers, as seen from the body.
    """

    turns: Array
    centres: Array
    shapes: Array

    @classmethod
    def of(cls, places: Array, weights: Array) -> Self:
        """Fit the body to markers in the room.

        Parameters
        ----------
        places : ndarray of shape (T, K, 3)
            At least three markers.
        weights : ndarray of shape (K,)
            Not negative.
        """
        shares = weights / weights.sum()
        centres = np.einsum("k,tki->ti", shares, places)
        around = places - centres[:, None]
        shape = around[len(around) // 2]
        for _ in range(_ROUNDS):
            turns = rotations(shape, around, shares)
            shapes = np.einsum("tkj,tij->tki", around, turns)
            shape = shapes.mean(axis=0)
        if not spans_a_body(shapes, shares):
            turns = least_rotations(shape, around, shares)
            shapes = np.einsum("tkj,tij->tki", around, turns)
        return cls(turns, centres, shapes)

    def to_body(self, places: Array) -> Array:
        """Return a marker (T, 3) of the room as seen from the body."""
        return np.asarray(np.einsum("tj,tij->ti", places - self.centres, self.turns))

    def to_room(self, seen: Array, frames: NDArray[np.intp]) -> Array:
        """Return a marker as seen from the body in some frames (n, 3) in the room."""
        return np.asarray(np.einsum("ti,tij->tj", seen, self.turns[frames]) + self.centres[frames])
