r"""A Gaussian process over frames, given its values at some of them.

All channels share the covariance up to a scale, :math:`\sigma_d^2 K`, and a trend :math:`H \beta_d`
with p coefficients, about which nothing is known before: :math:`p(\beta_d) \propto 1`. Whatever the
columns of H can express, added to a channel, is therefore added to its mean and changes nothing
else (universal kriging; C. E. Rasmussen and C. K. I. Williams 2006, *Gaussian Processes for Machine
Learning*, eq. 2.41 and 2.42). With the prior :math:`p(\sigma_d^2) \propto 1 / \sigma_d^2` the scale
is integrated out: the prediction of a channel is a Student t with ν = n − p degrees of freedom, n
being the number of visible frames. Its variance is ν / (ν − 2) times that with the scale :math:`(r
- H \beta)^\top K^{-1} (r - H \beta) / \nu`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from mocapbench.basics.arrays import Array, Index
from mocapbench.basics.mask_runs import runs

__all__ = ["ConditionedFrames", "copy_gaps", "growth_of_variance", "student_variance"]


@dataclass(frozen=True, eq=False)
class ConditionedFrames:
    """The distribution of all N frames given the n visible ones.

    Parameters
    ----------
    prior : ndarray of shape (N, N)
        Covariance between frames, noise left out, up to scale.
    noise : float
        Variance of the noise, up to the same scale; positive.
    visible : ndarray of bool, shape (N,)
        Which frames are visible; at least one.
    trend : ndarray of shape (N, p)
        The columns of H, linearly independent at visible frames; p may be 0.
    """

    prior: Array
    noise: float
    visible: NDArray[np.bool_]
    trend: Array

    @cached_property
    def _factor(self) -> tuple[Array, Any]:
        n_visible = int(self.visible.sum())
        among = self.prior[np.ix_(self.visible, self.visible)]
        return cho_factor(among + self.noise * np.eye(n_visible), lower=True)

    @cached_property
    def _trend_dual(self) -> Array:
        """(n, p) K⁻¹H at the visible frames."""
        return np.asarray(cho_solve(self._factor, self.trend[self.visible]))

    @cached_property
    def _trend_precision(self) -> Array:
        """(p, p) HᵀK⁻¹H."""
        return np.asarray(self.trend[self.visible].T @ self._trend_dual)

    def _coefficients(self, residuals: Array) -> Array:
        """Return β = (HᵀK⁻¹H)⁻¹HᵀK⁻¹r of each channel (p, D)."""
        return np.asarray(np.linalg.solve(self._trend_precision, self._trend_dual.T @ residuals))

    def _without_trend(self, residuals: Array) -> Array:
        """Return r − Hβ of each channel (n, D)."""
        return np.asarray(residuals - self.trend[self.visible] @ self._coefficients(residuals))

    def mean(self, residuals: Array) -> Array:
        """Return the mean (N, D) given residuals (n, D) at the visible frames."""
        trend = self.trend @ self._coefficients(residuals)
        dual = cho_solve(self._factor, self._without_trend(residuals))
        return np.asarray(trend + self.prior[:, self.visible] @ dual)

    @cached_property
    def variance(self) -> Array:
        """(N,) variance of each frame, noise and doubt about the trend included, up to scale."""
        cross = self.prior[:, self.visible]
        explained = (cross * cho_solve(self._factor, cross.T).T).sum(axis=1)
        # R = H* − K*K⁻¹H: what the visible frames leave open of the trend.
        open_trend = self.trend - cross @ self._trend_dual
        doubt = (open_trend * np.linalg.solve(self._trend_precision, open_trend.T).T).sum(axis=1)
        return np.asarray(np.diagonal(self.prior) + self.noise - explained + doubt)

    @property
    def _freedom(self) -> int:
        return int(self.visible.sum() - self.trend.shape[1])

    def scales(self, residuals: Array, least: float) -> Array:
        """Return the scale of each channel (D,), at least ``least``."""
        # (r − Hβ)ᵀ K⁻¹ (r − Hβ) / ν
        beside = self._without_trend(residuals)
        quadratic = (beside * cho_solve(self._factor, beside)).sum(axis=0)
        return np.asarray(np.maximum(quadratic / max(self._freedom, 1), least))

    def log_evidence(self, scales: Array) -> Array:
        """Return the log-density of each channel (D,), its scale integrated out, up to a constant.

        Parameters
        ----------
        scales : ndarray of shape (D,)
            As `scales` returns them.
        """
        # ½ log|K| + ½ log|HᵀK⁻¹H|, and the marginal likelihood −½ ν log σ̂² less it.
        half_log_determinant = np.log(np.diagonal(self._factor[0])).sum()
        half_log_determinant += 0.5 * np.linalg.slogdet(self._trend_precision)[1]
        return np.asarray(-0.5 * self._freedom * np.log(scales) - half_log_determinant)

    @cached_property
    def _precision(self) -> Array:
        """(n, n) K⁻¹ − K⁻¹H (HᵀK⁻¹H)⁻¹HᵀK⁻¹ of the visible frames."""
        inverse = cho_solve(self._factor, np.eye(int(self.visible.sum())))
        explained = self._trend_dual @ np.linalg.solve(self._trend_precision, self._trend_dual.T)
        return np.asarray(inverse - explained)

    def leave_out(self, stretches: Sequence[Index], residuals: Array, scales: Array) -> Array:
        """Return sums (2, D) of squared errors, and of their variances, of stretches left out.

        Each stretch is told from all other visible frames, which determine the trend, too.

        Parameters
        ----------
        stretches : sequence of ndarray of int, shape (m,)
            Which of the n visible frames; see `copy_gaps`.
        residuals : ndarray of shape (n, D)
        scales : ndarray of shape (D,)
            As `scales` returns them.
        """
        sums, dual = np.zeros((2, residuals.shape[1])), self._precision @ residuals
        for left_out in stretches:
            # With P the precision and frames g left out: P_gg⁻¹ (P r)_g, of covariance P_gg⁻¹ (C.
            # E. Rasmussen and C. K. I. Williams 2006, §5.4.2).
            covariance = np.linalg.inv(self._precision[np.ix_(left_out, left_out)])
            sums[0] += ((covariance @ dual[left_out]) ** 2).sum(axis=0)
            sums[1] += self.doubt_of_scale * np.trace(covariance) * scales
        return sums

    def products(self, residuals: Array, scales: Array) -> Array:
        """Return the products (K, K) of K residuals, each in units of its standard deviation.

        They are sums over channels of rᵀP r', with P the precision of the visible frames.

        Parameters
        ----------
        residuals : ndarray of shape (K, n, D)
        scales : ndarray of shape (D,)
            As `scales` returns them.
        """
        weighted = self._precision @ residuals / scales
        return np.tensordot(weighted, residuals, axes=((1, 2), (1, 2)))

    def variances(self, scales: Array) -> Array:
        """Return the variance (N, D) of each frame and channel, the scale integrated out."""
        return self.doubt_of_scale * np.outer(self.variance, scales)

    @property
    def doubt_of_scale(self) -> float:
        """By what the variance grows because the scale is inferred: ν / (ν − 2) if ν > 2."""
        return student_variance(self._freedom)


def student_variance(n_values: int) -> float:
    """Return the variance of Student's t, with as many degrees of freedom, of unit scale.

    It is n / (n − 2), which is infinite for n = 2 and has no meaning below. With one or two values
    it is that of three: no more values ever make it larger.

    Examples
    --------
    >>> [student_variance(n) for n in (1, 2, 3, 4, 6)]
    [3.0, 3.0, 3.0, 2.0, 1.5]
    """
    n_counted = max(n_values, 3)
    return n_counted / (n_counted - 2)


def copy_gaps(visible: NDArray[np.bool_]) -> list[Index]:
    """Return stretches as long as the median gap, by their numbers among the visible frames.

    A frame on either side is visible. Stretches are shorter where visible ones are, and overlap by
    half.

    Examples
    --------
    >>> copy_gaps(np.array([True, False, False, True, True, True, True]))
    [array([2, 3])]
    """
    number = np.cumsum(visible) - 1
    length = int(np.median([len(gap) for gap in runs(~visible)] or [1]))
    stretches = []
    for inner in [number[run[1:-1]] for run in runs(visible)]:
        size = min(length, len(inner))
        firsts = range(0, len(inner) - size + 1, max(size // 2, 1)) if size else ()
        stretches += [inner[first : first + size] for first in firsts]
    return stretches


def growth_of_variance(sums: Array) -> float:
    """Return by what variances grow where squared errors are more than expected; at least 1.

    Parameters
    ----------
    sums : ndarray of shape (2, D)
        Of squared errors and of their variances; 0 where nothing was left out.

    Notes
    -----
    Gaps can be longer than all that is left out. Variances that grow on to their length, by its
    power .4 or by what halves of the stretches tell, hold .92 to .93 of gaps of two seconds in
    place of .89 to .91 (22 people of ``datasets/people.tsv``, recordings that are learnt from), but
    CRPS is 1 to 3 % larger there and in ``missing-frames``: not adopted.
    """
    squares, expected = sums.sum(axis=1)
    return float(max(squares / expected, 1.0)) if expected > 0.0 else 1.0
