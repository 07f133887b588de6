r"""The basis in which the covariance of one component with complete data is diagonal.

The covariance of a single unit with one component, all of whose entries are visible with a noise
:math:`\nu_d` that does not change in time, is :math:`K = u B \otimes k + \operatorname{diag}(\nu)
\otimes I`. With :math:`u\, \nu^{-1/2} B \nu^{-1/2} = V \operatorname{diag}(\lambda) V^\top` and
:math:`k = Z \operatorname{diag}(\mu) Z^\top` both terms are diagonal in the basis
:math:`\nu^{1/2} V \otimes Z`,

.. math:: K = (\nu^{1/2} V \otimes Z) \operatorname{diag}(1 + \lambda_i \mu_j)
          (\nu^{1/2} V \otimes Z)^\top.

The symbols are those of docs/mathematics/solvers.md, section 7.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.gp.prior.kernels import StationaryKernel
from mocapbench.baselines.gp.prior.parameters import LayerParameters, Parameters
from mocapbench.baselines.gp.solvers.block import Block
from mocapbench.basics.arrays import Array

__all__ = ["KroneckerBasis", "is_kronecker"]


def is_kronecker(block: Block, parameters: Parameters) -> bool:
    """Return whether a block has one unit, one component, no hidden entry and constant noise."""
    layers = [parameters.layers[name] for name in block.units]
    return bool(
        len(block.observed) == 1
        and block.observed.all()
        and [layer.log_lengthscales.size for layer in layers] == [1]
        and np.all(block.noise_scale == block.noise_scale[:, :, :1])
    )


@dataclass(frozen=True, eq=False)
class KroneckerBasis:
    """The diagonal covariance of a block, and the block's data in its basis.

    Parameters
    ----------
    block, parameters, layer : Block, Parameters, LayerParameters
        The problem and its one layer.
    noise : ndarray of shape (D,)
        ν.
    gram : float
        u.
    outputs : ndarray of shape (D, D)
        Ṽ = ν^(−1/2) V.
    times : ndarray of shape (N, N)
        Z.
    strengths : ndarray of shape (D,)
        λ.
    spectrum : ndarray of shape (N,)
        μ.
    variances : ndarray of shape (D, N)
        σ = 1 + λ_i μ_j.
    data : ndarray of shape (h, D, N)
        a_r = Ṽᵀ z_r Z / σ.
    squares : float
        Σ_r z_rᵀ K⁻¹ z_r.
    """

    block: Block
    parameters: Parameters
    layer: LayerParameters
    noise: Array
    gram: float
    outputs: Array
    times: Array
    strengths: Array
    spectrum: Array
    variances: Array
    data: Array
    squares: float

    @classmethod
    def of(cls, kernel: StationaryKernel, block: Block, parameters: Parameters) -> KroneckerBasis:
        """Diagonalise ``block`` at ``parameters``."""
        ((name, gram),) = block.grams.items()
        layer = parameters.layers[name]
        noise = parameters.noise * block.noise_scale[0, :, 0]
        roots, u = np.sqrt(noise), float(gram[0, 0])
        # λ and V, μ and Z.
        strengths, vectors = np.linalg.eigh(
            u * layer.coregionalisation.matrices[0] / np.outer(roots, roots)
        )
        spectrum, times = np.linalg.eigh(kernel.value(block.lags, layer.lengthscales[0]))
        # Ṽ, σ, t_r = Ṽᵀ z_r Z and a_r = t_r / σ.
        outputs = vectors / roots[:, None]
        variances = 1.0 + np.outer(strengths, spectrum)
        rotated = outputs.T @ block.data[:, 0] @ times
        data = rotated / variances
        return cls(
            block,
            parameters,
            layer,
            noise,
            u,
            outputs,
            times,
            strengths,
            spectrum,
            variances,
            data,
            float(np.vdot(rotated, data)),
        )

    @property
    def log_density(self) -> float:
        """The log-density of the block's data."""
        n_times = len(self.spectrum)
        log_determinant = np.log(self.variances).sum() + n_times * np.log(self.noise).sum()
        log_scale = log_determinant + self.block.n_visible * np.log(2.0 * np.pi)
        return float(-0.5 * (self.block.multiplicity * log_scale + self.squares))

    def rotate(self, matrix: Array) -> Array:
        """Return Ṽ X Ṽᵀ for a matrix X, (D, D)."""
        return np.asarray(self.outputs @ matrix @ self.outputs.T)
