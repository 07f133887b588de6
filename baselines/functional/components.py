"""Functional principal components of cycles with hidden entries, by penalised likelihood.

The coefficients of cycle j in channel d are c_jd = m_d + Σ_q s_jq w_qd with scores s_j ~ N(0, I),
and its entries x = bᵀ(u) c_jd plus noise of variance σ_d². Mean and components maximise the
likelihood of the visible entries less half the weighted roughness. The scores are integrated out,
and with them the hidden entries: this is the probabilistic reading of filling hidden entries,
decomposing, and filling again (M. E. Tipping and C. M. Bishop 1999, Probabilistic principal
component analysis, Journal of the Royal Statistical Society B 61).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.common.ascent import Ascent, ascend
from mocapbench.baselines.functional.fourier_series import (
    CurveStatistics,
    fourier,
    norms,
    roughness,
)
from mocapbench.basics.arrays import Array, Index

__all__ = [
    "LEAST_NOISE",
    "ComponentFit",
    "cycle_moments",
    "find_principal_axes",
    "fit_components",
    "infer_scores",
    "penalised_likelihood",
    "prototypes",
    "sample_curves",
    "start_components",
    "update_components",
]

LEAST_NOISE = 1e-4
"""Least variance of the noise, for channels of unit variance: the constant ones have none."""
_LEAST_WEIGHT = 1e-6  # of a cycle without visible entries, which may be all that a recording has


@dataclass(frozen=True, eq=False)
class ComponentFit:
    """Mean, components and noise of cycles, and the posterior of the scores of J cycles.

    Parameters
    ----------
    coefficients : ndarray of shape (Q + 1, D, P)
        Of the mean, then of each component, scaled by its standard deviation.
    noise : ndarray of shape (D,)
        Variance of the noise of each channel.
    mean : ndarray of shape (J, Q)
        Posterior mean of the scores.
    covariance : ndarray of shape (J, Q, Q)
        Posterior covariance of the scores.
    log_likelihood : ndarray of shape (J,)
        Of the visible entries of each cycle, scores integrated out.
    """

    coefficients: Array
    noise: Array
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


def fit_components(
    statistics: CurveStatistics,
    initial: tuple[Array, Array],
    smoothness: float,
    *,
    max_iter: int,
    tol: float,
) -> Ascent[ComponentFit]:
    """Alternate scores and components until the likelihood has converged.

    Parameters
    ----------
    statistics : CurveStatistics
        Of J cycles.
    initial : tuple of ndarray
        The coefficients and the noise to start with.
    smoothness : float
        Weight of the roughness.
    max_iter : int
        Largest number of rounds.
    tol : float
        It has once a round raises it by less than this per visible entry.
    """
    return ascend(
        infer_scores(statistics, *initial),
        lambda now: infer_scores(statistics, *update_components(statistics, now, smoothness)),
        lambda now: penalised_likelihood(now, smoothness),
        max_iter=max_iter,
        threshold=tol * statistics.counts.sum(),
    )


def start_components(
    statistics: CurveStatistics, curve: Array, n_components: int, smoothness: float
) -> tuple[Array, Array]:
    """Return coefficients and noise from the singular values of each cycle's smooth deviations.

    Parameters
    ----------
    statistics : CurveStatistics
        Of J cycles.
    curve : ndarray of shape (D, P)
        The mean curve.
    n_components : int
        Q, at most J − 1.
    smoothness : float
        Weight of the roughness.
    """
    n_cycles, (n_channels, n_functions) = len(statistics.squares), curve.shape
    # What is left of Σ v b x without the mean curve.
    gradient = statistics.cross - (statistics.grams @ curve[..., None])[..., 0]
    # A deviation has prior variance 1: a cycle of few visible entries keeps close to the mean.
    ridge = np.diag(1.0 + smoothness * roughness((n_functions - 1) // 2))
    deviations = np.linalg.solve(statistics.grams + ridge, gradient[..., None])[..., 0]
    weights = np.tile(np.sqrt(norms((n_functions - 1) // 2)), n_channels)
    _, lengths, axes = np.linalg.svd(
        deviations.reshape(n_cycles, -1) * weights, full_matrices=False
    )
    scaled = lengths[:n_components, None] / np.sqrt(n_cycles) * axes[:n_components] / weights
    components = scaled.reshape(-1, n_channels, n_functions)
    # The squared errors of the mean curve c: squares − 2 cᵀ cross + cᵀ gram c.
    errors = statistics.squares.sum(axis=0) - np.einsum(
        "dp,dp->d", curve, statistics.cross.sum(axis=0) + gradient.sum(axis=0)
    )
    return np.concatenate([curve[None], components]), _noise(errors, statistics)


def infer_scores(statistics: CurveStatistics, coefficients: Array, noise: Array) -> ComponentFit:
    """Return the posterior of the scores of each cycle, with what it is conditional on."""
    n_cycles, size = len(statistics.squares), len(coefficients)
    # Σ_d w_ad ᵀ gram_jd w_bd / σ_d² and Σ_d w_ad ᵀ cross_jd / σ_d² of mean and components a, b.
    whitened = coefficients / noise[:, None]
    outer = np.einsum("adp,bdq->dpqab", whitened, coefficients)
    quadratic = statistics.grams.reshape(n_cycles, -1) @ outer.reshape(-1, size * size)
    quadratic = quadratic.reshape(n_cycles, size, size)
    linear = statistics.cross.reshape(n_cycles, -1) @ whitened.reshape(size, -1).T
    # The posterior N(S r, S), with S⁻¹ = I + quadratic and r the components' part of the residual.
    precision = np.eye(size - 1) + quadratic[:, 1:, 1:]
    right = linear[:, 1:] - quadratic[:, 0, 1:]
    covariance = np.linalg.inv(precision)
    mean = (covariance @ right[..., None])[..., 0]
    # log N(x; mean curve, W Wᵀ + Σ) by Woodbury's identity and the determinant lemma.
    error = statistics.squares @ (1.0 / noise) - 2.0 * linear[:, 0] + quadratic[:, 0, 0]
    determinant = np.linalg.slogdet(precision)[1] + statistics.counts @ np.log(2.0 * np.pi * noise)
    log_likelihood = -0.5 * (error - (right * mean).sum(axis=1) + determinant)
    return ComponentFit(coefficients, noise, mean, covariance, log_likelihood)


def penalised_likelihood(fit: ComponentFit, smoothness: float) -> float:
    """Return the log-likelihood of all visible entries less half the weighted roughness."""
    weights = roughness((fit.coefficients.shape[2] - 1) // 2)
    penalty = smoothness * float((fit.coefficients**2 @ weights).sum())
    return float(fit.log_likelihood.sum()) - 0.5 * penalty


def update_components(
    statistics: CurveStatistics, fit: ComponentFit, smoothness: float
) -> tuple[Array, Array]:
    """Return the coefficients that maximise the expected penalised likelihood, then the noise."""
    size, n_channels, n_functions = fit.coefficients.shape
    n_cycles = len(statistics.squares)
    # Σ_j E[(1, s)(1, s)ᵀ] ⊗ gram_jd, the normal matrix of the regression on scores and phases.
    grams = fit.moments.reshape(n_cycles, -1).T @ statistics.grams.reshape(n_cycles, -1)
    grams = grams.reshape(size, size, n_channels, n_functions, n_functions)
    normal = grams.transpose(2, 0, 3, 1, 4).reshape(n_channels, size * n_functions, -1)
    # Σ_j E[(1, s)] ⊗ cross_jd, its right side.
    cross = fit.padded.T @ statistics.cross.reshape(n_cycles, -1)
    cross = cross.reshape(size, n_channels, n_functions).swapaxes(0, 1).reshape(n_channels, -1)
    weights = np.tile(smoothness * roughness((n_functions - 1) // 2), size)
    penalty = fit.noise[:, None, None] * np.diag(weights)
    solved = np.linalg.solve(normal + penalty, cross[..., None])[..., 0]
    # The expected squared errors: squares − 2 cᵀ cross + cᵀ normal c.
    errors = (
        statistics.squares.sum(axis=0)
        - 2.0 * (solved * cross).sum(axis=1)
        + np.einsum("dp,dpq,dq->d", solved, normal, solved)
    )
    coefficients = solved.reshape(n_channels, size, n_functions).swapaxes(0, 1)
    return np.asarray(coefficients), _noise(errors, statistics)


def find_principal_axes(coefficients: Array) -> Array:
    """Return the same model with orthogonal components, the one of most variance first.

    Functions are orthogonal in the mean over a cycle, summed over channels. Scores that are
    standard normal remain so under a rotation.
    """
    mean, loadings = coefficients[0], coefficients[1:]
    weights = np.sqrt(norms((mean.shape[1] - 1) // 2))
    rotation = np.linalg.svd(
        (loadings * weights).reshape(len(loadings), mean.size), full_matrices=False
    )[0]
    rotated = np.tensordot(rotation.T, loadings, axes=1)
    return np.asarray(np.concatenate([mean[None], rotated]), dtype=np.float64)


def cycle_moments(phases: Sequence[Array], fit: ComponentFit) -> tuple[Array, Array]:
    """Return mean and variance of the entries at the ``phases`` (N_j,) of each cycle.

    Returns
    -------
    mean, variance : ndarray of shape (ΣN_j, D)
        Cycle after cycle; the variance is that of an observation, noise included.
    """
    means, variances = [], []
    for at, mean, covariance in zip(phases, fit.padded, fit.covariance, strict=True):
        # bᵀ(u) w_ad of mean and components: the mean is linear in them, the variance quadratic.
        basis = fourier(at, (fit.coefficients.shape[2] - 1) // 2)
        functions = np.einsum("np,adp->nda", basis, fit.coefficients)
        spread = np.einsum("nda,ab,ndb->nd", functions[..., 1:], covariance, functions[..., 1:])
        means.append(functions @ mean)
        variances.append(spread + fit.noise)
    return np.concatenate(means), np.concatenate(variances)


def prototypes(fit: ComponentFit, counts: Array, owners: Index) -> Array:
    """Return the coefficients of the mean of each recording's cycles: (K, D, P).

    Parameters
    ----------
    fit : ComponentFit
    counts : ndarray of shape (J,)
        The numbers of visible entries by which cycles are weighted.
    owners : ndarray of int, shape (J,)
        The recording of each cycle.
    """
    weights = np.maximum(counts, _LEAST_WEIGHT)
    shares = (owners == np.arange(owners[-1] + 1)[:, None]) * weights
    shares /= shares.sum(axis=1, keepdims=True)
    return np.asarray(np.tensordot(shares @ fit.padded, fit.coefficients, axes=1))


def sample_curves(coefficients: Array, n_states: int) -> Array:
    """Return the functions with coefficients (…, D, P) at M states of the cycle: (…, M, D)."""
    basis = fourier(np.arange(n_states) / n_states, (coefficients.shape[-1] - 1) // 2)
    return np.asarray(basis @ coefficients.swapaxes(-1, -2))


def _noise(errors: Array, statistics: CurveStatistics) -> Array:
    """Return the mean squared errors (D,), given their sums over visible entries."""
    counts = np.maximum(statistics.counts.sum(axis=0), 1.0)
    return np.asarray(np.maximum(errors / counts, LEAST_NOISE))
