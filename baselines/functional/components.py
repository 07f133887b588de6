"""Functional principal components of cycles with hidden entries, by penalised likelihood.

The coefficients of cycle j in channel d are c_jd = m_d + Σ_q s_jq w_qd with scores s_j ~ N(0, I),
and its entries x = bᵀ(u) c_jd plus noise of variance σ_d². Mean and components maximise the
likelihood of the visible entries less half the weighted roughness. The scores are integrated out,
and with them the hidden entries: this is the probabilistic reading of filling hidden entries,
decomposing, and filling again (M. E. Tipping and C. M. Bishop 1999, Probabilistic principal
component analysis, Journal of the Royal Statistical Society B 61).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.functional.basis import norms, roughness
from mocapbench.baselines.functional.statistics import CurveStatistics
from mocapbench.basics.arrays import Array

__all__ = [
    "LEAST_NOISE",
    "Components",
    "Scores",
    "infer_scores",
    "penalised_likelihood",
    "principal_axes",
    "update",
]

LEAST_NOISE = 1e-4
"""Least variance of the noise, for channels of unit variance: the constant ones have none."""


@dataclass(frozen=True, eq=False)
class Components:
    """Mean, components and noise of cycles.

    Parameters
    ----------
    coefficients : ndarray of shape (Q + 1, D, P)
        Of the mean, then of each component, scaled by its standard deviation.
    noise : ndarray of shape (D,)
        Variance of the noise of each channel.
    """

    coefficients: Array
    noise: Array


@dataclass(frozen=True, eq=False)
class Scores:
    """The posterior of the scores of J cycles, and the likelihood of each.

    Parameters
    ----------
    mean : ndarray of shape (J, Q)
    covariance : ndarray of shape (J, Q, Q)
    log_likelihood : ndarray of shape (J,)
        Of the visible entries of each cycle, scores integrated out.
    """

    mean: Array
    covariance: Array
    log_likelihood: Array

    @property
    def padded(self) -> Array:
        """(J, Q + 1) the mean of (1, s), 1 for the mean curve."""
        return np.hstack([np.ones((len(self.mean), 1)), self.mean])

    @property
    def moments(self) -> Array:
        """(J, Q + 1, Q + 1) the expected outer product of (1, s)."""
        moments = self.padded[:, :, None] * self.padded[:, None, :]
        moments[:, 1:, 1:] += self.covariance
        return moments


def infer_scores(statistics: CurveStatistics, components: Components) -> Scores:
    """Return the posterior of the scores of each cycle."""
    n_cycles, size = len(statistics.squares), len(components.coefficients)
    whitened = components.coefficients / components.noise[:, None]
    outer = np.einsum("adp,bdq->dpqab", whitened, components.coefficients)
    quadratic = statistics.grams.reshape(n_cycles, -1) @ outer.reshape(-1, size * size)
    quadratic = quadratic.reshape(n_cycles, size, size)
    linear = statistics.cross.reshape(n_cycles, -1) @ whitened.reshape(size, -1).T
    precision = np.eye(size - 1) + quadratic[:, 1:, 1:]
    right = linear[:, 1:] - quadratic[:, 0, 1:]
    covariance = np.linalg.inv(precision)
    mean = (covariance @ right[..., None])[..., 0]
    error = statistics.squares @ (1.0 / components.noise) - 2.0 * linear[:, 0] + quadratic[:, 0, 0]
    determinant = np.linalg.slogdet(precision)[1] + statistics.counts @ np.log(
        2.0 * np.pi * components.noise
    )
    return Scores(mean, covariance, -0.5 * (error - (right * mean).sum(axis=1) + determinant))


def penalised_likelihood(scores: Scores, components: Components, smoothness: float) -> float:
    """Return the log-likelihood of all visible entries less half the weighted roughness."""
    weights = roughness((components.coefficients.shape[2] - 1) // 2)
    penalty = smoothness * float((components.coefficients**2 @ weights).sum())
    return float(scores.log_likelihood.sum()) - 0.5 * penalty


def update(
    statistics: CurveStatistics, scores: Scores, components: Components, smoothness: float
) -> Components:
    """Return the components that maximise the expected penalised likelihood, then the noise."""
    size, n_channels, n_functions = components.coefficients.shape
    n_cycles = len(statistics.squares)
    # Σ_j E[(1, s)(1, s)ᵀ] ⊗ gram_jd, the normal matrix of the regression on scores and phases
    grams = scores.moments.reshape(n_cycles, -1).T @ statistics.grams.reshape(n_cycles, -1)
    grams = grams.reshape(size, size, n_channels, n_functions, n_functions)
    normal = grams.transpose(2, 0, 3, 1, 4).reshape(n_channels, size * n_functions, -1)
    cross = scores.padded.T @ statistics.cross.reshape(n_cycles, -1)
    cross = cross.reshape(size, n_channels, n_functions).swapaxes(0, 1).reshape(n_channels, -1)
    weights = np.tile(smoothness * roughness((n_functions - 1) // 2), size)
    penalty = components.noise[:, None, None] * np.diag(weights)
    solved = np.linalg.solve(normal + penalty, cross[..., None])[..., 0]
    errors = (
        statistics.squares.sum(axis=0)
        - 2.0 * (solved * cross).sum(axis=1)
        + np.einsum("dp,dpq,dq->d", solved, normal, solved)
    )
    noise = np.maximum(errors / np.maximum(statistics.counts.sum(axis=0), 1.0), LEAST_NOISE)
    coefficients = solved.reshape(n_channels, size, n_functions).swapaxes(0, 1)
    return Components(np.asarray(coefficients), np.asarray(noise))


def principal_axes(components: Components) -> Components:
    """Return the same model with orthogonal components, the one of most variance first.

    Functions are orthogonal in the mean over a cycle, summed over channels. Scores that are
    standard normal remain so under a rotation.
    """
    mean, *_ = components.coefficients
    loadings = components.coefficients[1:]
    weights = np.sqrt(norms((mean.shape[1] - 1) // 2))
    rotation = np.linalg.svd(
        (loadings * weights).reshape(len(loadings), mean.size), full_matrices=False
    )[0]
    turned = np.tensordot(rotation.T, loadings, axes=1)
    coefficients = np.concatenate([mean[None], turned])
    return Components(np.asarray(coefficients, dtype=np.float64), components.noise)
