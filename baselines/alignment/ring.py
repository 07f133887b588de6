r"""Gaussians on a ring: precisions that are cyclic tridiagonal plus diagonal.

The precision :math:`\lambda L + \mathrm{diag}(r)`, L the Laplacian of a ring of M states, is an
electrical network: conductance :math:`\lambda` between neighbours, :math:`r_m` to the ground.
Eliminating a state replaces its star by a mesh between its two neighbours. Every term of that is
positive, so nothing cancels however smooth the ring is; one sweep forward and one back give the
mean, the variances, the covariances of neighbours and the determinant, for any number of rings at
once, in time linear in M.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.alignment.sequences import Array

__all__ = ["Elimination", "Ring", "eliminate", "solve"]


@dataclass(frozen=True)
class Ring:
    """A Gaussian on each ring of a batch.

    Parameters
    ----------
    mean : ndarray of shape (M, …)
    variance : ndarray of shape (M, …)
        Diagonal of the covariance.
    neighbour : ndarray of shape (M, …)
        Covariance of each state with the next one; of the last state with the first.
    log_determinant : ndarray of shape (…)
        That of the precision.
    """

    mean: Array
    variance: Array
    neighbour: Array
    log_determinant: Array


@dataclass(frozen=True)
class Elimination:
    """The states of a ring eliminated in order, each upon the next one and the last one.

    Parameters
    ----------
    pivots : ndarray of shape (M, …)
        Conductance of each state, when its turn comes, to all that is left.
    near, far : ndarray of shape (M − 1, …)
        The shares of it that lead to the next state and to the last.
    """

    pivots: Array
    near: Array
    far: Array

    def forward(self, right: Array) -> Array:
        """Return what each state passes on when ``right`` (M, …) flows in: the forward sweep."""
        flow = right.copy()
        for m, (near, far) in enumerate(zip(self.near, self.far, strict=True)):
            flow[m + 1] += near * flow[m]
            flow[-1] += far * flow[m]
        return flow

    def backward(self, potential: Array) -> Array:
        """Add to each state (M, …) its share of the next and of the last: the backward sweep."""
        potential = potential.copy()
        for m in reversed(range(len(self.near))):
            potential[m] += self.near[m] * potential[m + 1] + self.far[m] * potential[-1]
        return potential


def eliminate(edge: float, ground: Array) -> Elimination:
    r"""Factorise :math:`\lambda L + \mathrm{diag}(r)`.

    Parameters
    ----------
    edge : float
        :math:`\lambda \geq 0`.
    ground : ndarray of shape (M, …)
        :math:`r > 0`.
    """
    pivots = ground.copy()
    near, far = np.empty_like(ground[1:]), np.empty_like(ground[1:])
    chord: float | Array = edge  # between the state whose turn it is and the last
    for m in range(len(near)):
        leak = pivots[m].copy()
        pivots[m] += edge + chord
        near[m] = edge / pivots[m]
        far[m] = chord / pivots[m]
        pivots[m + 1] += near[m] * leak
        pivots[-1] += far[m] * leak
        chord = near[m] * chord
    return Elimination(pivots, near, far)


def solve(edge: float, ground: Array, right: Array) -> Ring:
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
    factor = eliminate(edge, ground)
    mean = factor.backward(factor.forward(right) / factor.pivots)
    variance = 1.0 / factor.pivots
    neighbour = np.empty_like(variance)
    corner = variance[-1]  # covariance of the state with the last
    for m in reversed(range(len(ground) - 1)):
        neighbour[m] = factor.near[m] * variance[m + 1] + factor.far[m] * corner
        corner = factor.near[m] * corner + factor.far[m] * variance[-1]
        variance[m] += factor.near[m] * neighbour[m] + factor.far[m] * corner
    neighbour[-1] = corner
    return Ring(mean, variance, neighbour, np.log(factor.pivots).sum(axis=0))
