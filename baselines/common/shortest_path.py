"""The path of least cost through a trellis (the Viterbi algorithm)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["cheapest_path"]

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
        The cost of going from state (row) to state (column); infinite where that is impossible.

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
    # Back from the cheapest last state.
    path = [int(cost.argmin())]
    for best in reversed(before):
        path.append(int(best[path[-1]]))
    return np.asarray(path[::-1], dtype=np.intp)
