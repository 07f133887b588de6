"""The path of least cost through a trellis (the Viterbi algorithm)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["cheapest_path", "cheapest_path_among"]

_ROWS = 64


def cheapest_path(
    emission: NDArray[np.float64], transition: NDArray[np.float64]
) -> NDArray[np.intp]:
    """Return the states s_1 … s_T that minimise Σ_t emission[t, s_t] + transition[s_t, s_{t+1}].

    Parameters
    ----------
    emission : ndarray of shape (T, S)
        The cost of each state at each time.
    transition : ndarray of shape (S, S)
        The cost of going from state (row) to state (column); infinite where that is impossible. It
        is copied unless the rows of each column are neighbours in memory.

    Returns
    -------
    ndarray of int, shape (T,)
        The states. Ties go to the state with the smallest index.
    """
    states = np.arange(emission.shape[1])
    cost, before = emission[0], []
    # What leads to a state stands in a row, and few rows at once stay in the cache: numpy finds the
    # least of neighbours several times as fast as that of a column.
    leading = np.ascontiguousarray(transition.T)
    blocks = [leading[first : first + _ROWS] for first in range(0, len(states), _ROWS)]
    # The least cost of reaching each state, and the state before it on that path.
    for here in emission[1:]:
        best = np.concatenate([(block + cost).argmin(axis=1) for block in blocks])
        cost = cost[best] + transition[best, states] + here
        before.append(best)
    return _go_back(cost, before)


def cheapest_path_among(
    emission: NDArray[np.float64], transition: NDArray[np.float64]
) -> NDArray[np.intp]:
    """Return the cheapest path where the states that may be taken differ from time to time.

    Parameters
    ----------
    emission : ndarray of shape (T, W)
        The cost of each of W states at each time.
    transition : ndarray of shape (T - 1, W, W)
        The cost of going from a state at a time (row) to a state at the next (column).

    Returns
    -------
    ndarray of int, shape (T,)
        Which of the W states are taken. Ties go to the first.
    """
    cost, before = emission[0], []
    for jumps, here in zip(transition, emission[1:], strict=True):
        reached = cost[:, None] + jumps
        before.append(reached.argmin(axis=0))
        cost = reached.min(axis=0) + here
    return _go_back(cost, before)


def _go_back(cost: NDArray[np.float64], before: list[NDArray[np.intp]]) -> NDArray[np.intp]:
    """Return the path to the cheapest last state, given which state is best before each."""
    path = [int(cost.argmin())]
    for best in reversed(before):
        path.append(int(best[path[-1]]))
    return np.asarray(path[::-1], dtype=np.intp)
