r"""Inference in one component and complete data, by two eigendecompositions.

The covariance of a single unit with one component, all of whose entries are visible with a noise
:math:`\nu_d` that does not change in time, is :math:`K = u B \otimes k + \operatorname{diag}(\nu)
\otimes I`. With :math:`u\, \nu^{-1/2} B \nu^{-1/2} = V \operatorname{diag}(\lambda) V^\top` and
:math:`k = Z \operatorname{diag}(\mu) Z^\top` both terms are diagonal in the basis
:math:`\nu^{1/2} V \otimes Z`,

.. math:: K = (\nu^{1/2} V \otimes Z) \operatorname{diag}(1 + \lambda_i \mu_j)
          (\nu^{1/2} V \otimes Z)^\top,

so that everything costs :math:`O(N^3 + D^3)` and, for each data vector, :math:`O(D N (D + N))`:
the deviations from a mean in an intrinsic coregionalisation model, and its independent draws.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.prior.kernels import Kernel
from mocapbench.baselines.gp.prior.parameters import Layer, Parameters
from mocapbench.baselines.gp.solvers.block import Block, Target
from mocapbench.baselines.gp.solvers.solver import Posterior, Solver

__all__ = ["Kronecker"]

Array = NDArray[np.float64]

OVERHEAD = 8e6
"""What a block costs besides its matrix products, as operations (about half a millisecond)."""
EIGEN = 12.0
"""Operations of a symmetric eigendecomposition, in cubes of the side, at the speed of products."""


class Kronecker(Solver):
    """O(N³ + D³ + h D N (D + N)): for one component and complete data."""

    name: ClassVar[str] = "kronecker"
    needs: ClassVar[str] = (
        "one component, one layer and complete recordings, as in the deviations from a mean"
    )

    def evaluate(self, block: Block, parameters: Parameters) -> tuple[float, Parameters]:
        """Return the log-density of the block's data and its gradient."""
        basis = _Basis.of(self.kernel, block, parameters)
        return basis.log_density, _gradient(self.kernel, basis)

    def condition(self, block: Block, parameters: Parameters) -> Posterior:
        """Return the posterior given the block's data."""
        return _KroneckerPosterior(self.kernel, _Basis.of(self.kernel, block, parameters))

    def work(self, block: Block, parameters: Parameters) -> float:
        """Return 12 (N³ + D³) + 1.5 h D N (D + N) and an overhead, or infinity."""
        if not _is_kronecker(block, parameters):
            return np.inf
        h, _, n_outputs, n_times = block.data.shape
        products = 1.5 * h * n_outputs * n_times * (n_outputs + n_times)
        return float(EIGEN * (n_times**3 + n_outputs**3) + products + OVERHEAD)


def _is_kronecker(block: Block, parameters: Parameters) -> bool:
    layers = [parameters.layers[name] for name in block.units]
    return bool(
        len(block.observed) == 1
        and block.observed.all()
        and [layer.log_lengthscales.size for layer in layers] == [1]
        and np.all(block.noise_scale == block.noise_scale[:, :, :1])
    )


@dataclass(frozen=True, eq=False)
class _Basis:
    """The basis in which the covariance is diagonal, and the data in it.

    Parameters
    ----------
    block, parameters, layer : Block, Parameters, Layer
        The problem and its one layer.
    noise : ndarray of shape (D,)
        ν.
    gram : float
        u.
    outputs : ndarray of shape (D, D)
        ν^(−1/2) V.
    times : ndarray of shape (N, N)
        Z.
    strengths : ndarray of shape (D,)
        λ.
    spectrum : ndarray of shape (N,)
        μ.
    variances : ndarray of shape (D, N)
        1 + λ_i μ_j.
    data : ndarray of shape (h, D, N)
        (ν^(−1/2) V)ᵀ z Z, over the variances.
    squares : float
        Σ_r z_rᵀ K⁻¹ z_r.
    """

    block: Block
    parameters: Parameters
    layer: Layer
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
    def of(cls, kernel: Kernel, block: Block, parameters: Parameters) -> _Basis:
        """Diagonalise ``block`` at ``parameters``."""
        ((name, gram),) = block.grams.items()
        layer = parameters.layers[name]
        noise = parameters.noise * block.noise_scale[0, :, 0]
        roots, u = np.sqrt(noise), float(gram[0, 0])
        strengths, vectors = np.linalg.eigh(
            u * layer.coregionalisation.matrices[0] / np.outer(roots, roots)
        )
        spectrum, times = np.linalg.eigh(kernel.value(block.lags, layer.lengthscales[0]))
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


def _gradient(kernel: Kernel, basis: _Basis) -> Parameters:
    block, rho, data = basis.block, basis.block.multiplicity, basis.data
    slope = basis.times.T @ kernel.gradient(block.lags, basis.layer.lengthscales[0]) @ basis.times
    inverse = rho / basis.variances
    outer = np.tensordot(data * basis.spectrum, data, axes=((0, 2), (0, 2)))
    by_matrix = 0.5 * basis.gram * _rotated(basis, outer - np.diag(inverse @ basis.spectrum))
    weighted = np.tensordot(data * basis.strengths[:, None], data, axes=((0, 1), (0, 1)))
    by_scale = 0.5 * (np.vdot(slope, weighted) - basis.strengths @ inverse @ np.diagonal(slope))
    squares = np.tensordot(data, data, axes=((0, 2), (0, 2)))
    by_noise = 0.5 * np.diagonal(_rotated(basis, squares - np.diag(inverse.sum(axis=1))))
    layers = {name: layer.zeros() for name, layer in basis.parameters.layers.items()}
    (name,) = block.units
    layers[name] = Layer(
        np.array([by_scale]), basis.layer.coregionalisation.pull_back(by_matrix[None])
    )
    return Parameters(layers, basis.noise * by_noise)


def _rotated(basis: _Basis, matrix: Array) -> Array:
    """Return ν^(−1/2) V X Vᵀ ν^(−1/2)."""
    return np.asarray(basis.outputs @ matrix @ basis.outputs.T)


class _KroneckerPosterior(Posterior):
    def __init__(self, kernel: Kernel, basis: _Basis) -> None:
        self.kernel, self.basis = kernel, basis

    def predict(self, target: Target, times: Array) -> tuple[Array, Array]:
        basis, b = self.basis, self.basis.layer.coregionalisation
        ((name, factor),) = basis.block.units.items()
        scale = float(factor[0] @ target.weights[name])
        lags = np.subtract.outer(times, basis.block.times)
        by_time = self.kernel.value(lags, basis.layer.lengthscales[0]) @ basis.times
        by_output = scale * b.matrices[0] @ basis.outputs
        mean = by_output @ basis.data @ by_time.T
        explained = by_output**2 @ (1.0 / basis.variances) @ (by_time**2).T
        variance = np.maximum(target.prior_scale(name) * b.variances[:, None] - explained, 0.0)
        return mean, basis.block.share_of_variance * variance
