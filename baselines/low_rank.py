"""Probabilistic principal component analysis of frames with hidden entries, by EM."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.ascent import ascend
from mocapbench.baselines.common.checks import check_given, check_recordings, check_spread
from mocapbench.baselines.common.recordings import by_content
from mocapbench.baselines.common.scaling import OwnMeans
from mocapbench.baselines.common.validation import check_count, check_positive, check_share
from mocapbench.baselines.protocols import Imputer, Inductive, Prediction
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["LowRank"]


_ENTRIES_PER_LOADING = 10
"""Visible entries that a loading needs: fewer do not determine it (a rule of thumb)."""
_LEAST_NOISE = 1e-6
"""Least variance of the noise, in units of the variance within recordings."""
_PRIOR_NOISE = 0.05
"""The noise that is expected before anything is seen, in the same units; it counts as one entry.

Where few entries are visible together, loadings may fit them exactly, and the likelihood then grows
without bound as the noise vanishes (a Heywood case)."""


class LowRank(Imputer, Inductive):
    r"""Fill hidden channels of a frame along the main directions in which poses vary (PPCA).

    A frame is :math:`y = m + S (W x + \varepsilon)` with latent :math:`x \sim N(0, I_q)` and noise
    :math:`\varepsilon \sim N(0, \sigma^2 I)`. The mean m is the recording's own, of its visible
    entries, and the scale S that within recordings. W and σ² maximise the likelihood of all visible
    entries of the recordings given to `fit`, times a prior of σ² that is worth one more entry with
    an error of 0.05 (in units of S squared), by EM from the principal axes of the covariances of
    entries visible together. Complete frames are not needed.

    The number q of components is the least that holds ``explained_variance`` of the start's
    variance; there are at most one fewer than channels, and so few that ten visible entries stand
    behind each loading.

    It learns nothing over time: frames that are hidden as a whole take the recording's own mean of
    each channel, and so do all hidden entries where q = 0. A channel never visible in a recording
    takes its mean over the recordings given to `fit`. The predictive variance does not include the
    uncertainty of the mean and of W.

    Parameters
    ----------
    explained_variance : float, default=0.95
        Share of variance that the components hold at the start, from 0 to 1.
    max_iter : int, default=100
        Largest number of iterations of EM.
    tol : float, default=1e-5
        EM stops when the objective gains less than this for each visible entry; positive.

    Attributes
    ----------
    recordings_ : tuple of Recording
        The recordings given to `fit`.
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    own_means_ : OwnMeans
        The scale S, and the means of channels over all recordings.
    loadings_ : ndarray of shape (D, q)
        W, in units of S.
    noise_variance_ : float
        σ², in units of S squared.
    objective_ : ndarray of shape (n_iterations + 1,)
        Log-likelihood of the visible entries in units of S plus the logarithm of the prior, at the
        start and after each iteration.
    n_iterations_, converged_ : int, bool

    References
    ----------
    M. E. Tipping and C. M. Bishop (1999), Probabilistic Principal Component Analysis, Journal of
    the Royal Statistical Society B 61(3).

    A. Ilin and T. Raiko (2010), Practical Approaches to Principal Component Analysis in the
    Presence of Missing Values, JMLR 11, §3.3: EM where entries are missing.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import LowRank
    >>> from mocapbench.datasets import Recording
    >>> times = np.arange(40.0)
    >>> angle = 2 * np.pi * times / 10
    >>> values = np.column_stack([np.sin(angle), 5.0 - 2.0 * np.sin(angle)])
    >>> swing = Recording("swing", times, values, ("hip", "knee"), ("deg", "deg"))
    >>> gap = np.column_stack([times < 0, (times >= 10) & (times < 20)])
    >>> given = swing.hide(gap)
    >>> (prediction,) = LowRank().fit([given]).impute([given])
    >>> bool(np.abs(prediction.mean - values).max() < 0.01)
    True
    """

    family: ClassVar[str] = "Across channels"
    provides: ClassVar[frozenset[str]] = Imputer.provides | Inductive.provides | {"scales along"}

    def __init__(
        self,
        explained_variance: float = 0.95,
        *,
        max_iter: int = 100,
        tol: float = 1e-5,
    ) -> None:
        self.explained_variance = explained_variance
        self.max_iter = max_iter
        self.tol = tol

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Learn the loadings and the noise.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, a name
            repeats, or a channel has a single visible entry.
        """
        check_share("explained_variance", self.explained_variance)
        check_count("max_iter", self.max_iter, 1)
        check_positive("tol", self.tol)
        checked = by_content(check_recordings(recordings))
        check_spread(checked)
        self.recordings_ = checked
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        self.own_means_: OwnMeans = OwnMeans.of(checked)
        frames = _Frames.of(np.concatenate([self.own_means_.apply(one) for one in checked]))
        self._learn(frames, *_start(frames, self.explained_variance))
        return self

    def _learn(self, frames: _Frames, loadings: Array, noise: float) -> None:
        run = ascend(
            _Fit.of(frames, loadings, noise),
            lambda now: _Fit.of(frames, *_maximise_parameters(frames, now)),
            lambda now: now.log_likelihood + _log_prior(now.noise),
            max_iter=self.max_iter,
            threshold=self.tol * max(float(frames.seen.sum()), 1.0),
        )
        self.loadings_: Array = run.state.loadings
        self.noise_variance_: float = run.state.noise
        self.objective_: Array = np.array(run.objectives)
        self.n_iterations_: int = run.n_iterations
        self.converged_: bool = run.converged

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the mean and variance of hidden entries given the visible ones of their frame.

        Raises
        ------
        ValueError
            If channels differ, or a channel is visible neither in a recording nor in those given to
            `fit`.
        """
        check_given(self, recordings)
        return [self._fill_recording(recording) for recording in recordings]

    def _fill_recording(self, recording: Recording) -> Prediction:
        frames = _Frames.of(self.own_means_.apply(recording))
        posterior = _Fit.of(frames, self.loadings_, self.noise_variance_)
        mean = self.own_means_.restore(recording, posterior.latents @ self.loadings_.T)
        spread = np.einsum("di,nij,dj->nd", self.loadings_, posterior.covariances, self.loadings_)
        variance = (spread[frames.pattern] + self.noise_variance_) * self.own_means_.scale**2
        return Prediction.around(recording, mean, variance)


@dataclass(frozen=True, eq=False)
class _Frames:
    """Frames with zeros at hidden entries (N, D), and which of P sets of entries each shows."""

    values: FrameByChannel
    seen: Array  # (N, D), 1 or 0
    patterns: Array  # (P, D), 1 or 0
    pattern: NDArray[np.intp]  # (N,)

    @classmethod
    def of(cls, deviations: FrameByChannel) -> _Frames:
        seen = (~np.isnan(deviations)).astype(np.float64)
        patterns, pattern = np.unique(seen, axis=0, return_inverse=True)
        # NumPy 2.0 returned the inverse as a column.
        return cls(np.nan_to_num(deviations), seen, patterns, pattern.ravel())


@dataclass(frozen=True, eq=False)
class _Fit:
    """Loadings and noise, and the latents given the visible entries: Tipping and Bishop §3.2."""

    loadings: Array
    noise: float
    latents: Array  # (N, q), the means
    covariances: Array  # (P, q, q), by set of visible entries
    log_likelihood: float

    @classmethod
    def of(cls, frames: _Frames, loadings: Array, noise: float) -> _Fit:
        """Infer the latents, with M = WᵀW + σ²I over the visible channels of a frame."""
        q = loadings.shape[1]
        outer = np.einsum("di,dj->dij", loadings, loadings)
        precisions = np.tensordot(frames.patterns, outer, 1) + noise * np.eye(q)
        inverses = np.asarray(np.linalg.inv(precisions), dtype=np.float64)
        projected = frames.values @ loadings
        latents = np.einsum("nij,nj->ni", inverses[frames.pattern], projected)
        # By Woodbury's identity and the determinant lemma, (W Wᵀ + σ²I)⁻¹ and its determinant.
        counts = frames.seen.sum(axis=1)
        log_determinants = np.linalg.slogdet(precisions)[1][frames.pattern]
        log_determinants += (counts - q) * np.log(noise)
        distances = ((frames.values**2).sum(axis=1) - (projected * latents).sum(axis=1)) / noise
        losses = counts * np.log(2 * np.pi) + log_determinants + distances
        return cls(loadings, noise, latents, noise * inverses, -0.5 * float(losses.sum()))


def _maximise_parameters(frames: _Frames, posterior: _Fit) -> tuple[Array, float]:
    """Return the loadings and noise of the M-step: Ilin and Raiko 2010, §3.3."""
    latents, q = posterior.latents, posterior.latents.shape[1]
    # ⟨x xᵀ⟩ of each frame, summed over the frames in which a channel is visible.
    moments = np.einsum("ni,nj->nij", latents, latents) + posterior.covariances[frames.pattern]
    second = np.tensordot(frames.seen.T, moments, 1)
    second[frames.seen.sum(axis=0) == 0.0] = np.eye(q)  # a channel never visible has no loadings
    # w_d = (Σ ⟨x xᵀ⟩)⁻¹ Σ y_d ⟨x⟩ minimises Σ ⟨(y_d − w_d x)²⟩, whose least value is the residual.
    cross = frames.values.T @ latents
    loadings = np.asarray(np.linalg.solve(second, cross[..., None])[..., 0], dtype=np.float64)
    residual = (frames.values**2).sum() - (loadings * cross).sum()
    return loadings, _noise(float(residual), float(frames.seen.sum()))


def _noise(squares: float, n_entries: float) -> float:
    """Return the most probable noise after so many entries with that sum of squared errors."""
    return max((squares + _PRIOR_NOISE) / (n_entries + 1.0), _LEAST_NOISE)


def _log_prior(noise: float) -> float:
    """Return the logarithm of the prior, up to a constant: that of one entry."""
    return -0.5 * (log(noise) + _PRIOR_NOISE / noise)


def _start(frames: _Frames, explained: float) -> tuple[Array, float]:
    """Return the loadings and noise that fit the covariances of entries visible together.

    They are the maximum of the objective if all frames are complete: Tipping and Bishop, eq. (7),
    and eq. (8) for the noise, with the prior.
    """
    together = np.maximum(frames.seen.T @ frames.seen, 1.0)
    # W = U_q (Λ_q − σ² I)^½, with σ² the mean of the eigenvalues that are left out.
    eigenvalues, axes = np.linalg.eigh(frames.values.T @ frames.values / together)
    eigenvalues, axes = np.maximum(eigenvalues[::-1], 0.0), axes[:, ::-1]
    q = _n_components(frames, eigenvalues, explained)
    n_frames = float(frames.seen.sum()) / len(eigenvalues)
    noise = _noise(n_frames * float(eigenvalues[q:].sum()), n_frames * (len(eigenvalues) - q))
    return axes[:, :q] * np.sqrt(np.maximum(eigenvalues[:q] - noise, 0.0)), noise


def _n_components(frames: _Frames, eigenvalues: Array, explained: float) -> int:
    sums = np.cumsum(eigenvalues)
    wanted = int(np.searchsorted(sums, explained * sums[-1])) + 1
    n_channels = len(eigenvalues)
    determined = int(frames.seen.sum()) // (_ENTRIES_PER_LOADING * n_channels)
    return min(wanted, n_channels - 1, determined)
