"""Gaussian-process regression of hidden channels on visible ones, over frames (kriging).

What the visible channels do around a frame says what the hidden ones do, and more surely so in the
same recording: a person on one day deviates in a similar way whenever the pose is similar.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np

from mocapbench.baselines.common.checks import check_given, check_recordings, pool
from mocapbench.baselines.common.recordings import by_content
from mocapbench.baselines.common.scaling import Standardisation
from mocapbench.baselines.kriging.channel_process import learn_channel_process, predict_channels
from mocapbench.baselines.kriging.described_frames import DescribedFrames, choose_near
from mocapbench.baselines.kriging.stacked import (
    describe_by_channels,
    stack_frames,
    weigh_channels,
)
from mocapbench.baselines.kriging.stances import find_stances
from mocapbench.baselines.protocols import Imputer, Inductive, Prediction
from mocapbench.basics.arrays import Array, Index
from mocapbench.basics.mask_runs import hidden_together, runs
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["ChannelKriging"]

_OTHERS = 1000
"""Frames of other recordings to learn and to predict from.

Three thousand take two to three times as long, and are not shown to err less
(`docs/results/people.md`).
"""


class ChannelKriging(Imputer, Inductive):
    r"""Predict hidden channels from the visible ones around a frame, by a Gaussian process.

    A frame x of recording r at time t is described by the visible channels in it and in the frames
    four and eight before and after. Each hidden channel has the covariance

    .. math:: \sigma_d^2 \left[(1 + \alpha\, \delta_{rr'})\, (1 + \beta\, x^\top x' + k)
        + \gamma\, \delta_{rr'}\, m(|t - t'| / \tau) + \varepsilon\, \delta\right], \qquad
        k = \left(1 + \|x - x'\|^2 / \ell^2\right)^{-1/2},

    where m is Matérn's once differentiable kernel. The first term is what all recordings share: a
    constant, a linear and a curved function of the visible channels; α is the part of it in which
    recordings differ, and γ the variance of a drift over time. A visible channel counts the more,
    the larger its coefficients in a ridge regression of the hidden ones on all visible ones.

    The process is conditioned on the frames of all recordings, those of the recording to fill
    included; of those of others, on the 1000 that are most like the frames to fill. The six
    parameters are those that best predict gaps that are held out of these, as long as those to
    fill. Such gaps say, too, how far variances are right.
    Markers are seen from the body: their path, and which way each recording faces, are taken out
    before, as far as three of them are visible throughout the recording to fill.
    Channels hidden in the same frames are filled together, with parameters of their own; where
    others are hidden besides, these are interpolated over time for the comparison.

    Time is counted in frames. The model has no parameters to
    choose: the medians of their priors, the ridge and the window are those with which limbs were
    filled best in recordings that are in no test; ``docs/results/people.md`` says what each part
    earns over thirty people.

    Attributes
    ----------
    recordings_ : tuple of Recording
        The recordings given to `fit`.

    References
    ----------
    Not from a publication. The Gaussian-process regression is that of C. E. Rasmussen and C. K. I.
    Williams (2006), Gaussian Processes for Machine Learning, MIT Press, eq. (2.25) and (2.26), and
    what is held out is predicted as in its §5.4.2; the task for which it was written is that of
    G. W. Taylor, G. E. Hinton and S. T. Roweis (2007), Modeling Human Motion Using Binary Latent
    Variables, NIPS 19.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import ChannelKriging
    >>> from mocapbench.datasets import FrameByChannel, Recording
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
    provides: ClassVar[frozenset[str]] = (
        Imputer.provides | Inductive.provides | {"moves along", "scales along"}
    )

    max_frames: ClassVar[int | None] = 3000
    learns_in_fit: ClassVar[bool] = False

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Keep the recordings.

        Raises
        ------
        ValueError
            If there is no recording, channels differ, or a name repeats.
        """
        self.recordings_: tuple[Recording, ...] = by_content(check_recordings(recordings))
        self.channels_: tuple[str, ...] = self.recordings_[0].channels
        self.units_: tuple[str, ...] = self.recordings_[0].units
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return each recording filled, independently of the others given here.

        Raises
        ------
        ValueError
            If channels differ, a channel is visible neither in a recording nor in those given to
            `fit`, or channels that are hidden together are visible together nowhere.
        """
        check_given(self, recordings)
        return [self._fill_recording(recording) for recording in recordings]

    def _fill_recording(self, recording: Recording) -> Prediction:
        pooled = pool(self.recordings_, [recording])
        own = [each.name for each in pooled].index(recording.name)
        stances = find_stances(pooled, own)
        alike = [stance.take_out(each) for stance, each in zip(stances, pooled, strict=True)]
        scaling = Standardisation.of(alike)
        stacked = stack_frames([scaling.apply(each) for each in alike])
        mean, variance = np.zeros_like(recording.values), np.ones_like(recording.values)
        for channels in hidden_together(~recording.visible):
            hidden = ~recording.visible[:, channels[0]]
            place = np.ix_(np.flatnonzero(hidden), channels)
            duration = float(np.median([len(gap) + 1 for gap in runs(hidden)]))
            mean[place], variance[place] = _moments(*stacked, own, channels, duration)
        mean, variance = scaling.mean + scaling.scale * mean, scaling.scale**2 * variance
        return stances[own].put_back(recording, mean, variance)


def _moments(
    values: FrameByChannel, frames: DescribedFrames, own: int, channels: Index, duration: float
) -> tuple[Array, Array]:
    """Return the mean and variance of ``channels`` where a recording hides them."""
    hidden = np.isnan(values[:, channels])
    known = np.flatnonzero(~hidden.any(axis=1))
    if not len(known):
        raise ValueError(
            f"expected a frame of some recording in which the {len(channels)} channels that "
            f"are hidden together (numbers {channels.tolist()} from 0) are all visible, got "
            f"none: give a recording that has such frames, or take a model that fills each "
            f"channel alone, such as pchip"
        )
    wanted = np.flatnonzero(hidden[:, 0] & (frames.recording == own))
    others = np.setdiff1d(np.arange(values.shape[1]), channels)
    weights = weigh_channels(values[known], frames.description[known], channels, others)
    given, sought = (
        describe_by_channels(frames.at(some), others, weights) for some in (known, wanted)
    )
    shown = values[np.ix_(known, channels)]
    spread = np.nanmean(values[:, channels] ** 2, axis=0)
    near = choose_near(given, sought, own, _OTHERS)
    given, shown = given.at(near), shown[near]
    process = learn_channel_process(given, shown, spread, own, duration)
    return predict_channels(given, shown, sought, *process)
