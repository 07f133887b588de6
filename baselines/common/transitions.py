"""A path through a gap whose steps are those that training frames near it made.

The path y_1 … y_n with given ends that minimises Σ_t ‖y_{t+1} − y_t − m_t‖² has the steps m_t plus
a constant: the difference between the given displacement y_n − y_1 and Σ_t m_t, divided by n − 1.
This is the solution of the tridiagonal normal equations in closed form. With only one end given
the constant is 0.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel

__all__ = ["fill_gap", "least_squares_path"]

Steps = Callable[[FrameByChannel], Array]
"""From frames (n, D) to the step (n, D) expected from each."""

_ROUNDS = 20
_TOLERANCE = 1e-6


def least_squares_path(steps: Array, path: FrameByChannel) -> FrameByChannel:
    """Return the path whose steps are nearest to the given ones, its visible ends fixed.

    Parameters
    ----------
    steps : ndarray of shape (n - 1, D)
        The steps m_t.
    path : ndarray of shape (n, D)
        The first frame, the last frame or both are given; all others are NaN.

    Returns
    -------
    ndarray of shape (n, D)
    """
    # The path of these steps from 0, shifted by what the ends ask for, linearly in between.
    free = np.concatenate([np.zeros((1, path.shape[1])), np.cumsum(steps, axis=0)])
    offsets = (path - free)[~np.isnan(path).any(axis=1)]
    return free + np.linspace(offsets[0], offsets[-1], len(path))


def fill_gap(path: FrameByChannel, steps: Steps) -> FrameByChannel:
    """Alternate between the steps expected on the current path and the path of these steps.

    Starts from the straight line between the ends (a constant if one is given) and stops after 20
    rounds, or when a round changes the path by less than 1e-6 of its norm.

    Parameters
    ----------
    path : ndarray of shape (n, D)
        As in `least_squares_path`.
    steps : callable
        From frames (n - 1, D) to the step (n - 1, D) expected from each.

    Returns
    -------
    ndarray of shape (n, D)
    """
    current = least_squares_path(np.zeros_like(path[1:]), path)
    for _ in range(_ROUNDS):
        previous, current = current, least_squares_path(steps(current[:-1]), path)
        if np.linalg.norm(current - previous) < _TOLERANCE * np.linalg.norm(previous):
            break
    return current
