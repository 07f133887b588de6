"""Minimisation over several arrays at once, for a stated number of iterations."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy.optimize import minimize

from mocapbench.basics.arrays import Array

__all__ = ["descend"]

ValueAndGradients = tuple[float, Sequence[Array]]


def descend(
    objective: Callable[..., ValueAndGradients], start: Sequence[Array], n_steps: int
) -> tuple[Array, ...]:
    """Return the arrays after at most ``n_steps`` iterations of L-BFGS.

    Parameters
    ----------
    objective : callable
        Takes as many arrays as ``start`` has and returns the value and one gradient an array.
    start : sequence of ndarray
        Where the search starts.
    n_steps : int
        Largest number of iterations. This is early stopping rather than convergence: the kernel
        parameters of these models keep drifting for thousands of iterations.
    """
    places = np.cumsum([array.size for array in start])[:-1]

    def parts(vector: Array) -> list[Array]:
        pieces = np.split(vector, places)
        return [piece.reshape(a.shape) for piece, a in zip(pieces, start, strict=True)]

    def flat(vector: Array) -> tuple[float, Array]:
        value, gradients = objective(*parts(vector))
        return value, np.concatenate([gradient.ravel() for gradient in gradients])

    result = minimize(
        flat,
        np.concatenate([array.ravel() for array in start]),
        jac=True,
        method="L-BFGS-B",
        options={"maxiter": n_steps, "maxfun": 20 * n_steps + 20, "ftol": 0.0, "gtol": 0.0},
    )
    return tuple(parts(result.x))
