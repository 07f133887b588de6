"""A stated number of steps downhill, in several arrays at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

__all__ = ["descend"]

Array = NDArray[np.float64]
Slope = tuple[float, Sequence[Array]]


def descend(
    objective: Callable[..., Slope], start: Sequence[Array], n_steps: int
) -> tuple[Array, ...]:
    """Return the arrays after at most ``n_steps`` iterations of L-BFGS.

    Parameters
    ----------
    objective : callable
        From as many arrays as ``start`` has to a value and its slopes with respect to each.
    start : sequence of ndarray
    n_steps : int
        Early stopping, not convergence: the parameters of the family keep drifting.
    """
    places = np.cumsum([array.size for array in start])[:-1]

    def parts(vector: Array) -> list[Array]:
        pieces = np.split(vector, places)
        return [piece.reshape(a.shape) for piece, a in zip(pieces, start, strict=True)]

    def flat(vector: Array) -> tuple[float, Array]:
        value, slopes = objective(*parts(vector))
        return value, np.concatenate([slope.ravel() for slope in slopes])

    found = minimize(
        flat,
        np.concatenate([array.ravel() for array in start]),
        jac=True,
        method="L-BFGS-B",
        options={"maxiter": n_steps, "maxfun": 20 * n_steps + 20, "ftol": 0.0, "gtol": 0.0},
    )
    return tuple(parts(found.x))
