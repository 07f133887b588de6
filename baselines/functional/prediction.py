"""The entries of cycles that components predict."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.baselines.functional.basis import fourier
from mocapbench.baselines.functional.components import Components, Scores
from mocapbench.baselines.functional.cycles import Cycles
from mocapbench.basics.arrays import Array

__all__ = ["cycle_moments", "prototypes", "sample_curves"]

_LEAST_WEIGHT = 1e-6  # of a cycle without visible entries, which may be all that a recording has


def cycle_moments(
    phases: Sequence[Array], components: Components, scores: Scores
) -> tuple[Array, Array]:
    """Return mean and variance of the entries at the ``phases`` (N_j,) of each cycle.

    Returns
    -------
    mean, variance : ndarray of shape (ΣN_j, D)
        Cycle after cycle; the variance is that of an observation, noise included.
    """
    parts = [
        _moments(at, components, mean, covariance)
        for at, mean, covariance in zip(phases, scores.padded, scores.covariance, strict=True)
    ]
    means, variances = zip(*parts, strict=True)
    return np.concatenate(means), np.concatenate(variances)


def prototypes(components: Components, scores: Scores, cycles: Cycles) -> Array:
    """Return the coefficients of the mean of each recording's cycles: (K, D, P).

    Cycles are weighted by their numbers of visible entries.
    """
    weights = np.maximum(cycles.statistics.counts.sum(axis=1), _LEAST_WEIGHT)
    shares = (cycles.owners == np.arange(cycles.owners[-1] + 1)[:, None]) * weights
    shares /= shares.sum(axis=1, keepdims=True)
    return np.asarray(np.tensordot(shares @ scores.padded, components.coefficients, axes=1))


def sample_curves(coefficients: Array, n_states: int) -> Array:
    """Return the functions with coefficients (…, D, P) at M states of the cycle: (…, M, D)."""
    basis = fourier(np.arange(n_states) / n_states, (coefficients.shape[-1] - 1) // 2)
    return np.asarray(basis @ coefficients.swapaxes(-1, -2))


def _moments(
    phases: Array, components: Components, mean: Array, covariance: Array
) -> tuple[Array, Array]:
    basis = fourier(phases, (components.coefficients.shape[2] - 1) // 2)
    functions = np.einsum("np,adp->nda", basis, components.coefficients)
    spread = np.einsum("nda,ab,ndb->nd", functions[..., 1:], covariance, functions[..., 1:])
    return functions @ mean, spread + components.noise
