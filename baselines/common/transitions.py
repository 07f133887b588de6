"""A path through a gap that moves as training frames near it moved.

The steps of a path y_1 … y_n with given ends that minimise Σ_t ‖y_{t+1} − y_t − m_t‖² are the
m_t, each corrected by an equal share of what their sum misses: the solution of the tridiagonal
normal equations, in closed form. With one end given nothing is missed.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets import FrameByChannel

__all__ = ["fill_gap", "least_squares_path"]

Array = NDArray[np.float64]
Steps = Callable[[FrameByChannel], Array]

_ROUNDS = 20
_TOLERANCE = 1e-6


def least_squares_path(steps: Array, path: FrameByChannel) -> FrameByChannel:
    """Return the path whose steps are nearest to the given ones, its visible ends fixed.

    Parameters
    ----------
    steps : ndarray of shape (n - 1, D)
        The steps m_t to come near to.
    path : ndarray of shape (n, D)
        Its first frame, its last frame or both are given, all others are NaN.
    """
    free = np.concatenate([np.zeros((1, path.shape[1])), np.cumsum(steps, axis=0)])
    missed = (path - free)[~np.isnan(path).any(axis=1)]
    return free + np.linspace(missed[0], missed[-1], len(path))


def fill_gap(path: FrameByChannel, steps: Steps) -> FrameByChannel:
    """Alternate between the steps expected on a path and the path of these steps.

    Starts from the straight line between the ends (a constant if one is given) and stops after 20
    rounds, or when a round changes the path by less than 1e-6 of its norm.

    Parameters
    ----------
    path : ndarray of shape (n, D)
        As in `least_squares_path`.
    steps : callable
        From frames (n - 1, D) to the step (n - 1, D) expected from each.
    """
    current = least_squares_path(np.zeros_like(path[1:]), path)
    for _ in range(_ROUNDS):
        previous, current = current, least_squares_path(steps(current[:-1]), path)
        if np.linalg.norm(current - previous) < _TOLERANCE * np.linalg.norm(previous):
            break
    return current
