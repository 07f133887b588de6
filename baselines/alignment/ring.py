r"""Gaussians on a ring: precisions that are cyclic tridiagonal plus diagonal.

The precision :math:`\lambda L + \mathrm{diag}(r)`, L the Laplacian of a ring of M states, is that
of an electrical network with conductance :math:`\lambda` between neighbours and :math:`r_m` from
state m to the ground. Eliminating a state replaces its edges to two neighbours and the ground by
edges among these three (the star–mesh transform). All terms are positive, so that no digits are
lost by cancellation even if :math:`\lambda` is large. One forward and one backward sweep give the
mean, the variances, the covariances of neighbours and the determinant, for any number of rings at
once, in time linear in M.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.basics.arrays import Array

__all__ = ["Ring", "eliminate", "solve_rings", "sweep_back"]


@dataclass(frozen=True)
class Ring:
    """A Gaussian on each ring of a batch.

    Parameters
    ----------
    mean : ndarray of shape (M, …)
        Mean of each state.
    variance : ndarray of shape (M, …)
        Diagonal of the covariance.
    neighbour : ndarray of shape (M, …)
        Covariance of each state with the next one; of the last state with the first.
    log_determinant : ndarray of shape (…)
        Log-determinant of the precision.
    """

    mean: Array
    variance: Array
    neighbour: Array
    log_determinant: Array


def eliminate(edge: float, ground: Array) -> tuple[Array, Array, Array]:
    r"""Factorise :math:`\lambda L + \mathrm{diag}(r)`, eliminating states in order 0 … M − 1.

    When a state is eliminated, it has two neighbours left: the next state and the last one.

    Parameters
    ----------
    edge : float
        :math:`\lambda \geq 0`.
    ground : ndarray of shape (M, …)
        :math:`r > 0`.

    Returns
    -------
    pivots : ndarray of shape (M, …)
        Total conductance of each state when it is eliminated, to the ground included.
    near, far : ndarray of shape (M − 1, …)
        The fractions of it that lead to the next state and to the last state.
    """
    pivots = ground.copy()
    near, far = np.empty_like(ground[1:]), np.empty_like(ground[1:])
    chord: float | Array = edge  # conductance between state m and the last state
    for m in range(len(near)):
        leak = pivots[m].copy()  # its own conductance to the ground
        pivots[m] += edge + chord
        near[m] = edge / pivots[m]
        far[m] = chord / pivots[m]
        # The star–mesh transform: the product of two edges over the pivot joins their other ends.
        pivots[m + 1] += near[m] * leak
        pivots[-1] += far[m] * leak
        chord = near[m] * chord
    return pivots, near, far


def sweep_back(near: Array, far: Array, potential: Array) -> Array:
    """Return the potentials given those (M, …) against the remaining states: backward sweep."""
    potential = potential.copy()
    for m in reversed(range(len(near))):
        potential[m] += near[m] * potential[m + 1] + far[m] * potential[-1]
    return potential


def solve_rings(edge: float, ground: Array, right: Array) -> Ring:
    r"""Return the Gaussians of precision :math:`\lambda L + \mathrm{diag}(r)`.

    Parameters
    ----------
    edge : float
        :math:`\lambda \geq 0`.
    ground : ndarray of shape (M, …), M at least 3
        :math:`r > 0`.
    right : ndarray of shape (M, …)
        Precision times mean.
    """
    pivots, near, far = eliminate(edge, ground)
    mean = sweep_back(near, far, _sweep_forward(near, far, right) / pivots)
    variance = 1.0 / pivots
    neighbour = np.empty_like(variance)
    # Backwards, each covariance is the average of those of the two states eliminated into.
    corner = variance[-1]  # covariance of the state with the last
    for m in reversed(range(len(ground) - 1)):
        neighbour[m] = near[m] * variance[m + 1] + far[m] * corner
        corner = near[m] * corner + far[m] * variance[-1]
        variance[m] += near[m] * neighbour[m] + far[m] * corner
    neighbour[-1] = corner
    return Ring(mean, variance, neighbour, np.log(pivots).sum(axis=0))


def _sweep_forward(near: Array, far: Array, right: Array) -> Array:
    """Return the current at each state for the inflow ``right`` (M, …): forward sweep."""
    flow = right.copy()
    for m, (to_next, to_last) in enumerate(zip(near, far, strict=True)):
        flow[m + 1] += to_next * flow[m]
        flow[-1] += to_last * flow[m]
    return flow
