"""Each training walker's way through the recording, and what they miss as a function of pose.

A new subject does not move like any subject of training, but deviates from them in much the same
way whenever the pose is much the same. So every training recording is matched with the new one by
its cheapest path (`PoseViterbi`), the paths are averaged, and the residuals at visible frames are
kriged: under a Gaussian process over the matched pose and time, they are known where the pose
comes again.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve
from sklearn.metrics.pairwise import euclidean_distances
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.gaps import hidden_frames, runs
from mocapbench.baselines.common.recordings import check_channels, check_recordings
from mocapbench.baselines.common.validation import check_not_negative, check_positive
from mocapbench.baselines.pose_viterbi import PoseViterbi
from mocapbench.baselines.protocols import FrameImputer, Inductive, Prediction
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["PoseKriging"]

Array = NDArray[np.float64]

_CONSTANT, _DRIFT, _NOISE = 10.0, 1.0, 0.05
"""Variances of the residual's constant part, its drift in time and its noise, up to scale."""
_LEAST_VARIANCE = 1e-12
"""Of a channel that is never missed, as a share of the variance of training."""


class PoseKriging(FrameImputer, Inductive):
    r"""Fill frames from matched training recordings and a Gaussian process of the residual.

    Recording k of training gives the poses :math:`m_k(t)` of its cheapest path, found after the
    offset of a first path has been taken off. Their mean :math:`m`, with weights
    :math:`\exp(-e_k / \min_j e_j)` by the mean squared residual :math:`e_k` at visible frames, is
    corrected by the conditional mean of a Gaussian process: each channel of :math:`y - m` has
    covariance :math:`\sigma_d^2 (10 + e^{-|t - t'| / \tau} + v\, e^{-\|m(t) - m(t')\|^2 / 2 h^2
    S} + 0.05\, \delta)`, S the total variance of training frames, :math:`\sigma_d^2` by maximum
    likelihood. The variance is that of this process; the path's own uncertainty is not in it.

    The defaults are those with the least error when each training walker of ``missing-frames`` is
    held out in turn. Frames are counted, not seconds.

    Parameters
    ----------
    smoothness : float, default=10.0
        As of `PoseViterbi`.
    pose_lengthscale : float, default=1.0
        h; positive.
    pose_variance : float, default=3.0
        v; not negative.
    time_lengthscale : float, default=4.0
        τ in frames; positive.

    Attributes
    ----------
    channels_ : tuple of D str
    matchers_ : list of PoseViterbi
        One for each training recording with two consecutive complete frames.
    spread_ : float
        S, the sum of the channels' variances in training.
    """

    def __init__(
        self,
        smoothness: float = 10.0,
        *,
        pose_lengthscale: float = 1.0,
        pose_variance: float = 3.0,
        time_lengthscale: float = 4.0,
    ) -> None:
        self.smoothness = smoothness
        self.pose_lengthscale = pose_lengthscale
        self.pose_variance = pose_variance
        self.time_lengthscale = time_lengthscale

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Keep the complete frames of each recording.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, a name
            repeats, or no two consecutive frames are complete.
        """
        for name in ("pose_lengthscale", "time_lengthscale"):
            check_positive(name, getattr(self, name))
        check_not_negative("pose_variance", self.pose_variance)
        checked = check_recordings(recordings)
        self.channels_ = checked[0].channels
        usable = [recording for recording in checked if _has_step(recording)]
        if not usable:
            raise ValueError("expected two consecutive complete frames in training, got none")
        self.matchers_ = [PoseViterbi(self.smoothness).fit([recording]) for recording in usable]
        frames = np.concatenate([matcher.frames_ for matcher in self.matchers_])
        self.spread_ = float(frames.var(axis=0).sum()) or 1.0
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return mean and variance of hidden frames.

        Raises
        ------
        ValueError
            If channels differ, a frame is hidden in part, or no frame is visible.
        """
        check_is_fitted(self)
        check_channels(recordings, self.channels_)
        return [
            Prediction.around(recording, *self._kriged(recording, self._matched(recording)))
            for recording in recordings
        ]

    def _matched(self, recording: Recording) -> FrameByChannel:
        """Return the weighted mean (N, D) of the training recordings' paths."""
        visible = ~hidden_frames(recording)
        paths = []
        for matcher in self.matchers_:
            moved = recording.with_values(recording.values - matcher.residual(recording))
            paths.append(matcher.match(moved))
        missed = [(recording.values - path)[visible].var(axis=0).sum() for path in paths]
        errors = np.asarray(missed) + np.finfo(float).tiny
        weights = np.exp(-errors / errors.min())
        return np.asarray(np.average(paths, axis=0, weights=weights))

    def _kriged(
        self, recording: Recording, matched: FrameByChannel
    ) -> tuple[FrameByChannel, FrameByChannel]:
        """Return ``matched`` with the residual's conditional mean added, and its variance."""
        visible = ~hidden_frames(recording)
        prior = self._covariance(matched)
        noisy = prior[np.ix_(visible, visible)] + _NOISE * np.eye(int(visible.sum()))
        factor = cho_factor(noisy, lower=True)
        residual = (recording.values - matched)[visible]
        dual = cho_solve(factor, residual)
        scales = np.maximum((residual * dual).mean(axis=0), _LEAST_VARIANCE * self.spread_)
        cross = prior[:, visible]
        explained = (cross * cho_solve(factor, cross.T).T).sum(axis=1)
        variance = np.diagonal(prior) + _NOISE - explained
        return matched + cross @ dual, np.outer(variance, scales)

    def _covariance(self, matched: FrameByChannel) -> Array:
        """Return the covariance (N, N) of a residual without noise, up to scale."""
        times = np.arange(len(matched))
        drift = np.exp(-np.abs(np.subtract.outer(times, times)) / self.time_lengthscale)
        distances = euclidean_distances(matched, squared=True) / self.spread_
        poses = np.exp(-0.5 * distances / self.pose_lengthscale**2)
        return np.asarray(_CONSTANT + _DRIFT * drift + self.pose_variance * poses)


def _has_step(recording: Recording) -> bool:
    return any(len(run) > 1 for run in runs(np.asarray(recording.visible.all(axis=1))))
