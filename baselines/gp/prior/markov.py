r"""Matérn kernels of half-integer order as Markov processes.

A draw of such a kernel is the first coordinate of an m-dimensional state that solves
:math:`dx = F x\, da + \sqrt{2m}\, e_m\, dw` in the scaled time
:math:`a = \sqrt{2m - 1}\, t / \ell`. In the coordinates that make the stationary covariance the
identity (orthogonalised derivatives), the drift is a Schwarz matrix: antisymmetric couplings
beside the diagonal, and :math:`-m` in its last entry. Its only eigenvalue is −1, so
:math:`F + I` is nilpotent, and over a scaled lag a

.. math:: \Phi = e^{-a} \sum_{k < m} \frac{a^k}{k!} (F + I)^k, \qquad
          Q = \int_0^a v v^\top ds, \quad v = \sqrt{2m}\, \Phi e_m.

The entries of :math:`v v^\top` are polynomials times :math:`e^{-2s}`, whose integrals are given by
the regularised incomplete gamma function. :math:`I - \Phi\Phi^\top` equals Q too, but loses all
digits for a short lag, where Q is of order :math:`a^{2m - 1}` (docs/mathematics/solvers.md,
section 6).

References
----------
Hartikainen, J. and Särkkä, S. (2010). Kalman filtering and smoothing solutions to temporal
Gaussian process regression models. IEEE International Workshop on Machine Learning for Signal
Processing.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from scipy.special import factorial, gammainc

from mocapbench.baselines.gp.prior.kernels import Matern12, Matern32, Matern52, StationaryKernel
from mocapbench.basics.arrays import Array

__all__ = ["is_markov", "state_order", "steps"]


_COUPLINGS: Mapping[type[StationaryKernel], tuple[float, ...]] = MappingProxyType(
    {Matern12: (), Matern32: (1.0,), Matern52: (np.sqrt(1.0 / 3.0), np.sqrt(8.0 / 3.0))}
)
"""The entries of the drift above its diagonal: its characteristic polynomial is (s + 1)^m."""

LONGEST_LAG = 700.0
"""Scaled lags are cut here: Φ is 0 in floating-point numbers from then on."""


def is_markov(kernel: StationaryKernel) -> bool:
    """Return whether a kernel has a finite state."""
    return type(kernel) in _COUPLINGS


def state_order(kernel: StationaryKernel) -> int:
    """Return m, the length of a kernel's state.

    Raises
    ------
    ValueError
        If the kernel has no finite state.
    """
    if not is_markov(kernel):
        raise ValueError(
            "expected a kernel with a finite state, one of "
            f"{sorted(known.__name__ for known in _COUPLINGS)}, got {type(kernel).__name__}: "
            "choose another kernel or solver"
        )
    return len(_COUPLINGS[type(kernel)]) + 1


def steps(kernel: StationaryKernel, lags: Array, lengthscales: Array) -> Array:
    """Return Φ and Q of x' | x ~ N(Φ x, Q) over T lags that may be infinite, for J lengthscales.

    Returns
    -------
    ndarray of shape (4, T, J, m, m)
        Φ, Q, and their derivatives in log ℓ.

    Raises
    ------
    ValueError
        If the kernel has no finite state.
    """
    order, drift = state_order(kernel), _drift(kernel)
    scaled = np.sqrt(2.0 * order - 1.0) * np.divide.outer(lags, lengthscales)
    a = np.minimum(scaled, LONGEST_LAG)[..., None, None]
    # Φ = e^(−a) Σ_k a^k (F + I)^k / k!, and v = √(2m) Φ e_m.
    powers = np.stack([np.linalg.matrix_power(drift + np.eye(order), k) for k in range(order)])
    powers /= factorial(np.arange(order))[:, None, None]
    transition = np.exp(-a) * sum(a**k * power for k, power in enumerate(powers))
    impulse = np.sqrt(2.0 * order) * transition[..., -1:]
    # ∂Φ / ∂ log ℓ = −a F Φ and ∂Q / ∂ log ℓ = −a v vᵀ.
    return np.stack(
        [
            transition,
            _noise(a, np.sqrt(2.0 * order) * powers[:, :, -1]),
            -a * (drift @ transition),
            -a * impulse * impulse.swapaxes(-1, -2),
        ]
    )


def _drift(kernel: StationaryKernel) -> Array:
    """Return F, (m, m)."""
    couplings = np.array(_COUPLINGS[type(kernel)])
    drift = np.diag(couplings, 1) - np.diag(couplings, -1)
    drift[-1, -1] = -len(drift)
    return np.asarray(drift)


def _noise(a: Array, impulse: Array) -> Array:
    """Return Q; ``impulse`` (m, m) holds the coefficients of v, powers of a along its rows."""
    degree = np.add.outer(np.arange(len(impulse)), np.arange(len(impulse)))
    integrals = gammainc(degree + 1, 2.0 * a) * factorial(degree) / 2.0 ** (degree + 1)
    return np.asarray(impulse.T @ integrals @ impulse)
