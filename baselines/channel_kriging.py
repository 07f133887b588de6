"""Gaussian-process regression of hidden channels on visible ones, over frames (kriging).

What the visible channels do around a frame says what the hidden ones do, and more surely so in the
same recording: a person on one day deviates in a similar way whenever the pose is similar.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from mocapbench.baselines.common.gaps import hidden_together
from mocapbench.baselines.common.recordings import check_recordings, pool
from mocapbench.baselines.common.scaling import Standardisation
from mocapbench.baselines.common.validation import check_not_negative, check_positive
from mocapbench.baselines.kriging.left_out import left_out_scales
from mocapbench.baselines.kriging.stacked import StackedFrames
from mocapbench.baselines.protocols import Imputer, Inductive, Prediction
from mocapbench.baselines.rehearsal.checkable import Widened
from mocapbench.baselines.rehearsal.rehearsing import rehearsed
from mocapbench.datasets import Recording

__all__ = ["ChannelKriging"]

Array = NDArray[np.float64]
Index = NDArray[np.intp]

_LEAST_SCALE = 1e-12
"""Least variance of a channel, as a fraction of its variance over all recordings."""


class ChannelKriging(Widened, Imputer, Inductive):
    r"""Predict hidden channels from the visible ones around a frame, by a Gaussian process.

    A frame x of recording r at time t is described by the visible channels in it and in the frames
    two and four before and after. Each hidden channel has the covariance

    .. math:: \sigma_d^2 \left[(1 + k)\, (1 + a\, \delta_{rr'})
        + b\, \delta_{rr'} e^{-|t - t'| / \tau} + \varepsilon\, \delta\right], \qquad
        k = \left(1 + \|x - x'\|^2 / \ell^2\right)^{-1/2},

    where the squared distance is the mean over the values that describe a frame, in units of the
    channels' standard deviations. The first term is what all recordings share; a is the part of it
    in which recordings differ, and b that of a drift over time. The scale is such that variances
    are right on average where each recording in turn is predicted from the others. Frames of all
    recordings, those of the recording to fill included, are what the process is conditioned on.
    Channels hidden in the same frames are filled together; where others are hidden besides, these
    are interpolated over time for the comparison.

    Variances are multiplied by what trials in the recording, and training recordings in its place,
    show (``docs/calibration.md``). What is hidden as a whole has nothing to be predicted from, and
    tends to the recording's mean. The defaults had the least error, of values a factor of two
    or more apart, where the second half of a leg or of the upper body was left out in each training
    recording of ``subject-35-missing`` in turn. Time is counted in frames.

    Parameters
    ----------
    lengthscale : float, default=1.0
        The distance ℓ, in standard deviations; positive.
    own : float, default=0.1
        The part a in which recordings differ; not negative.
    drift : float, default=0.1
        The variance b of a recording's drift; not negative.
    time_lengthscale : float, default=8.0
        How many frames τ a drift lasts; positive.
    noise : float, default=0.05
        The variance ε of the noise; positive.

    Attributes
    ----------
    recordings_ : tuple of Recording
        The recordings given to `fit`.

    References
    ----------
    Not from a publication. The Gaussian-process regression is that of C. E. Rasmussen and C. K. I.
    Williams (2006), Gaussian Processes for Machine Learning, MIT Press, eq. (2.25) and (2.26); the
    task for which it was written is that of G. W. Taylor, G. E. Hinton and S. T. Roweis (2007),
    Modeling Human Motion Using Binary Latent Variables, NIPS 19.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import ChannelKriging
    >>> from mocapbench.datasets import Recording
    >>> times = np.arange(60) / 30
    >>> angle = 2 * np.pi * np.arange(60) / 20
    >>> values = np.column_stack([np.sin(angle), np.cos(angle)])
    >>> walk = Recording("walk", times, values, ("hip", "knee"), ("deg", "deg"))
    >>> gap = np.column_stack([times < 0, (times >= 0.5) & (times < 1.2)])
    >>> given = walk.hide(gap)
    >>> (prediction,) = ChannelKriging().fit([given]).impute([given])
    >>> bool(np.abs(prediction.mean - values).max() < 0.1)
    True
    """

    family: ClassVar[str] = "Across channels"

    max_frames = 3000

    def __init__(
        self,
        lengthscale: float = 1.0,
        *,
        own: float = 0.1,
        drift: float = 0.1,
        time_lengthscale: float = 8.0,
        noise: float = 0.05,
    ) -> None:
        self.lengthscale = lengthscale
        self.own = own
        self.drift = drift
        self.time_lengthscale = time_lengthscale
        self.noise = noise

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Keep the recordings.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, or a name
            repeats.
        """
        for name in ("lengthscale", "time_lengthscale", "noise"):
            check_positive(name, getattr(self, name))
        for name in ("own", "drift"):
            check_not_negative(name, getattr(self, name))
        # In the order of names, so that the order given does not affect results.
        self.recordings_ = tuple(sorted(check_recordings(recordings), key=lambda r: r.name))
        self.channels_, self.units_ = self.recordings_[0].channels, self.recordings_[0].units
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return each recording filled, independently of the others given here.

        Variances are those claimed, times the mean of two ratios of squared errors to them: in
        trials on the recording's visible entries, and in training recordings that have its gaps.

        Raises
        ------
        ValueError
            If channels differ, a channel is visible neither in a recording nor in those given to
            `fit`, or channels that are hidden together are visible together nowhere.
        """
        self._check_given(recordings)
        return rehearsed(self, self.recordings_, recordings)

    def as_claimed(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the predictions of `impute`, with the variances that the model itself claims."""
        self._check_given(recordings)
        return [self._filled(recording) for recording in recordings]

    def _filled(self, recording: Recording) -> Prediction:
        pooled = pool(self.recordings_, [recording])
        scaling = Standardisation.of(pooled)
        frames = StackedFrames.of([scaling.apply(each) for each in pooled])
        number = [each.name for each in pooled].index(recording.name)
        rows = np.flatnonzero(frames.recording == number)
        mean, variance = np.zeros_like(recording.values), np.ones_like(recording.values)
        for channels in hidden_together(~recording.visible):
            hidden = np.flatnonzero(~recording.visible[:, channels[0]])
            place = np.ix_(hidden, channels)
            mean[place], variance[place] = self._moments(frames, rows[hidden], channels)
        mean, variance = scaling.mean + scaling.scale * mean, scaling.scale**2 * variance
        return Prediction.around(recording, mean, variance)

    def _moments(
        self, frames: StackedFrames, wanted: Index, channels: Index
    ) -> tuple[Array, Array]:
        """Return the mean and variance of ``channels`` in the frames ``wanted``."""
        values = frames.values[:, channels]
        known = np.flatnonzero(~np.isnan(values).any(axis=1))
        if not len(known):
            raise ValueError(
                f"expected a frame of some recording in which the {len(channels)} channels that "
                f"are hidden together (numbers {channels.tolist()} from 0) are all visible, got "
                f"none: give a recording that has such frames, or take a model that fills each "
                f"channel alone, such as pchip"
            )
        others = np.setdiff1d(np.arange(frames.values.shape[1]), channels)
        prior = self._covariance(frames, known, known, others)
        prior[np.diag_indices_from(prior)] += self.noise
        factor, lower = cho_factor(prior, lower=True, overwrite_a=True)
        dual = cho_solve((factor, lower), values[known])
        cross = self._covariance(frames, wanted, known, others)
        explained = (cross * cho_solve((factor, lower), cross.T).T).sum(axis=1)
        total = (1.0 + self.own) * 2.0 + self.drift + self.noise
        scales = left_out_scales(factor, dual, frames.recording[known])
        return cross @ dual, np.outer(total - explained, np.maximum(scales, _LEAST_SCALE))

    def _covariance(
        self, frames: StackedFrames, one: Index, other: Index, channels: Index
    ) -> Array:
        """Return the prior covariance (n, m) of frames without noise, up to scale."""
        covariance = frames.distances(one, other, channels)
        covariance /= self.lengthscale**2
        covariance += 1.0
        np.sqrt(covariance, out=covariance)
        np.reciprocal(covariance, out=covariance)
        covariance += 1.0
        for place, lags in frames.together(one, other):
            drift = self.drift * np.exp(-lags / self.time_lengthscale)
            covariance[place] = (1.0 + self.own) * covariance[place] + drift
        return covariance
