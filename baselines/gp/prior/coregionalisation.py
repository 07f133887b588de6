r"""Coregionalisation matrices :math:`B_q = W_q W_q^\top + \operatorname{diag}(\kappa_q)`.

They are the covariances between the outputs of a linear model of coregionalisation (eq. 15 of
J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017). The free parameters are :math:`W` and the
*signed root* :math:`\sqrt\kappa`. With the root an optimiser can reach, and leave,
:math:`\kappa = 0`; with :math:`\log\kappa` it would approach that value ever more slowly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.basics.arrays import Array

__all__ = ["Coregionalisation"]


@dataclass(frozen=True, eq=False)
class Coregionalisation:
    """Q matrices B_q in their free coordinates, or a gradient in these coordinates.

    Parameters
    ----------
    weights : ndarray of shape (Q, D, rank)
        The factors W_q; with rank 0 the matrices B_q are diagonal.
    kappa_roots : ndarray of shape (Q, D)
        Signed roots of κ_q.
    """

    weights: Array
    kappa_roots: Array

    @property
    def kappa(self) -> Array:
        """(Q, D) variances κ_q, which are not shared between outputs."""
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
            Derivatives with respect to the entries of B_q taken one by one. Its antisymmetric
            part has no effect, since B_q is symmetric.
        """
        diagonal = np.diagonal(adjoint, axis1=1, axis2=2)
        return Coregionalisation(
            (adjoint + adjoint.transpose(0, 2, 1)) @ self.weights,
            2.0 * self.kappa_roots * diagonal,
        )
