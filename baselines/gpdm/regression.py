"""Gaussian-process regression with several independent targets, integrated over the function.

The mapping from positions to poses and that to the next position have one form: with
K = k(inputs, inputs) + I / precision, each of the p columns of the targets T is N(0, K), as in
GPDM eq. (6) and (10). Given one set of inputs and targets, a further set has the density of
eq. (24) and (26). Log-parameters are those of the kernel, and last the log-precision of the noise.

Wang, Fleet and Hertzmann (2008), *Gaussian Process Dynamical Models for Human Motion*, IEEE TPAMI
30(2), is cited as GPDM.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.cholesky import mirror, potrf, potri
from mocapbench.baselines.gpdm.kernels import LatentKernel
from mocapbench.basics.arrays import Array

__all__ = [
    "ConditionedProcess",
    "condition_process",
    "invert",
    "log_start",
    "negative_log_likelihood",
    "signal_to_noise",
]

Moments = tuple[Array, Array, Callable[[Array, Array], Array]]

_NOISE_PRECISION = float(np.e)
"""From which learning starts: its logarithm is 1."""
_JITTERS = (0.0, *(10.0**power for power in range(-12, -3)))


def invert(matrix: Array) -> tuple[Array, float]:
    """Return the inverse and log-determinant of a positive definite ``matrix`` (n, n), n ≥ 0.

    If the factorisation fails, a multiple of the mean diagonal, from 1e-12 to 1e-4, is added.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the factorisation fails with the largest multiple too.
    """
    if not matrix.size:
        return matrix, 0.0
    scale = float(np.trace(matrix)) / len(matrix)
    for jitter in _JITTERS:
        factor = np.array(matrix, order="C")
        factor[np.diag_indices_from(factor)] += jitter * scale
        if potrf(factor) == 0:
            log_determinant = 2.0 * float(np.log(np.diagonal(factor)).sum())
            potri(factor)
            mirror(factor)
            return factor, log_determinant
    raise np.linalg.LinAlgError(
        f"expected a positive definite covariance of {len(matrix)} frames, got one that is not, "
        f"even with {_JITTERS[-1]:g} times its mean diagonal added"
    )


def log_start(kernel: LatentKernel) -> Array:
    """Return the logarithms of the parameters from which learning starts, the precision last."""
    return np.log([*kernel.start, _NOISE_PRECISION])


def negative_log_likelihood(
    kernel: LatentKernel, theta: Array, inputs: Array, targets: Array
) -> tuple[float, tuple[Array, Array, Array]]:
    """Return p/2 ln|K| + ½ tr(K⁻¹ T Tᵀ), constants left out.

    Its gradients follow, with respect to inputs, targets and log-parameters.
    """
    gram, pull = kernel(theta[:-1], inputs, inputs)
    inverse, log_determinant = invert(_add_noise(gram, theta))
    dual = inverse @ targets
    # ∂/∂K = ½ (p K⁻¹ − K⁻¹ T Tᵀ K⁻¹)
    gradient = dual @ (-0.5 * dual.T)
    gradient += 0.5 * targets.shape[1] * inverse
    left, right, d_kernel = pull(gradient)
    value = 0.5 * (targets.shape[1] * log_determinant + float((targets * dual).sum()))
    d_theta = np.append(d_kernel, -np.trace(gradient) * np.exp(-theta[-1]))
    return value, (left + right, dual, d_theta)


def condition_process(
    kernel: LatentKernel, theta: Array, inputs: Array, targets: Array
) -> ConditionedProcess:
    """Return the process given ``targets`` (n, p) at ``inputs`` (n, q)."""
    gram, _ = kernel(theta[:-1], inputs, inputs)
    inverse, _ = invert(_add_noise(gram, theta))
    return ConditionedProcess(kernel, theta, inputs, inverse, inverse @ targets)


def signal_to_noise(kernel: LatentKernel, theta: Array, n_inputs: int) -> float:
    """Return GPDM's SNR: the standard deviation at a unit vector over that of the noise."""
    unit = np.eye(1, n_inputs)
    variance = kernel.diagonal(theta[:-1], unit)[0]
    return float(np.sqrt(variance * np.exp(theta[-1])))


def _add_noise(gram: Array, theta: Array) -> Array:
    gram = gram.copy()
    gram[np.diag_indices_from(gram)] += np.exp(-theta[-1])
    return gram


@dataclass(frozen=True, eq=False)
class ConditionedProcess:
    """A process given targets at some inputs; the inverse is computed once.

    Parameters
    ----------
    kernel : LatentKernel
        The kernel of the process.
    theta : ndarray
        Log-parameters of the kernel, and last the log-precision of the noise.
    inputs : ndarray of shape (n, q)
        The inputs at which targets are given.
    inverse : ndarray of shape (n, n)
        K⁻¹.
    dual : ndarray of shape (n, p)
        K⁻¹ T.
    """

    kernel: LatentKernel
    theta: Array
    inputs: Array
    inverse: Array
    dual: Array

    def marginals(self, inputs: Array) -> tuple[Array, Array]:
        """Return the means (m, p) and variances (m,) of single targets, noise included.

        GPDM eq. (33) and (34), or (36) and (37).
        """
        cross, _ = self.kernel(self.theta[:-1], self.inputs, inputs)
        explained = (cross * (self.inverse @ cross)).sum(axis=0)
        noise = np.exp(-self.theta[-1])
        prior = self.kernel.diagonal(self.theta[:-1], inputs)
        return cross.T @ self.dual, np.maximum(prior - explained, 0.0) + noise

    def moments(self, inputs: Array) -> Moments:
        """Return the joint mean (m, p) and covariance (m, m), noise included, and a pullback.

        The pullback maps the gradients of a scalar with respect to both to its gradient (m, q)
        with respect to ``inputs``.
        """
        theta = self.theta[:-1]
        cross, pull_cross = self.kernel(theta, self.inputs, inputs)
        prior, pull_prior = self.kernel(theta, inputs, inputs)
        gain = self.inverse @ cross

        def pull(d_mean: Array, d_covariance: Array) -> Array:
            # Adjoints of the mean K_*ᵀ (K⁻¹ T) and of the explained part −K_*ᵀ K⁻¹ K_*.
            d_cross = self.dual @ d_mean.T - 2.0 * gain @ d_covariance
            left, right, _ = pull_prior(d_covariance)
            return left + right + pull_cross(d_cross)[1]

        return cross.T @ self.dual, _add_noise(prior, self.theta) - cross.T @ gain, pull

    def negative_log_density(
        self, inputs: Array, targets: Array, visible: NDArray[np.bool_]
    ) -> tuple[float, Array, Array]:
        """Return −ln of the density of new ``targets`` (m, p), and its gradients.

        The value is p/2 ln|S| + ½ tr(S_vv⁻¹ Z Zᵀ), with S the conditional covariance and Z the
        visible residuals. Hidden targets take their mean given the visible ones; the quadratic
        form of all targets then equals that of the visible ones. The gradients are those with
        respect to ``inputs`` and to ``targets``.
        """
        mean, covariance, pull = self.moments(inputs)
        rows = np.flatnonzero(visible)
        inverse, log_determinant = invert(covariance)
        some = len(rows) < len(visible)
        inverse_visible = invert(covariance[np.ix_(rows, rows)])[0] if some else inverse
        residual = (targets - mean)[rows]
        dual = np.zeros_like(mean)
        dual[rows] = inverse_visible @ residual
        # ∂/∂S = ½ (p S⁻¹ − S⁻¹ Z Zᵀ S⁻¹), where hidden rows of S⁻¹ Z are 0.
        d_covariance = 0.5 * (mean.shape[1] * inverse - dual @ dual.T)
        value = 0.5 * (mean.shape[1] * log_determinant + float((dual[rows] * residual).sum()))
        return value, pull(-dual, d_covariance), dual

    def fill_targets(
        self, inputs: Array, targets: Array, visible: NDArray[np.bool_]
    ) -> tuple[Array, Array]:
        """Return mean (m, p) and variance (m,) of all targets given the visible ones.

        Variances of hidden targets include noise; visible targets are copied, with variance 0.
        """
        mean, covariance, _ = self.moments(inputs)
        inverse, _ = invert(covariance[np.ix_(visible, visible)])
        # S_·v S_vv⁻¹, the regression of all targets on the visible ones.
        gain = covariance[:, visible] @ inverse
        mean = mean + gain @ (targets - mean)[visible]
        variance = np.diagonal(covariance) - (gain * covariance[:, visible]).sum(axis=1)
        return mean, np.where(visible, 0.0, np.maximum(variance, np.exp(-self.theta[-1])))
