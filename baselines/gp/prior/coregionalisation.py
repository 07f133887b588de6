r"""Coregionalisation matrices :math:`B_q = W_q W_q^\top + \operatorname{diag}(\kappa_q)`.

They say how the outputs of a linear model of coregionalisation vary together (thesis eq. 15).
The free parameters are :math:`W` and the *signed root* :math:`\sqrt\kappa`: with it an optimiser
can reach, and leave, :math:`\kappa = 0`, towards which :math:`\log\kappa` crawls for ever.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Coregionalisation"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Coregionalisation:
    """Q matrices B_q in their free coordinates, or a gradient with respect to them.

    Parameters
    ----------
    weights : ndarray of shape (Q, D, rank)
        The factors W_q; rank 0 leaves the diagonal alone.
    kappa_roots : ndarray of shape (Q, D)
        Signed roots of κ_q.
    """

    weights: Array
    kappa_roots: Array

    @property
    def kappa(self) -> Array:
        """(Q, D) variances that no other output shares."""
        return self.kappa_roots**2

    @property
    def matrices(self) -> Array:
        """(Q, D, D) the matrices B_q."""
        shared = self.weights @ self.weights.transpose(0, 2, 1)
        return shared + self.kappa[:, :, None] * np.eye(self.kappa.shape[1])

    @property
    def variances(self) -> Array:
        """(D,) marginal variance of each output, Σ_q diag B_q."""
        return np.asarray((self.weights**2).sum(axis=(0, 2)) + self.kappa.sum(axis=0))

    def pull_back(self, adjoint: Array) -> Coregionalisation:
        """Return the gradient in W and √κ of a function whose gradient in B_q is ``adjoint``.

        Parameters
        ----------
        adjoint : ndarray of shape (Q, D, D)
            Derivatives with respect to the entries of B_q taken one by one; its antisymmetric
            part is immaterial, since B_q is symmetric.
        """
        diagonal = np.diagonal(adjoint, axis1=1, axis2=2)
        return Coregionalisation(
            (adjoint + adjoint.transpose(0, 2, 1)) @ self.weights,
            2.0 * self.kappa_roots * diagonal,
        )
