"""Nearest neighbour: hidden entries are copied from the nearest training frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar, Self

import numpy as np
from sklearn.metrics.pairwise import nan_euclidean_distances
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_channels, check_recordings
from mocapbench.baselines.common.pose_units import pose_factors
from mocapbench.baselines.common.recordings import by_content, interpolate_channels, stack
from mocapbench.baselines.common.validation import check_not_negative
from mocapbench.baselines.protocols import Imputer, Inductive, Prediction
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["NN"]


class NN(Imputer, Inductive):
    r"""Copy hidden entries from the training frame that is nearest over the visible entries.

    The distance is the mean squared difference over the entries that are visible in both frames. An
    entry is copied from the nearest training frame in which it is visible, so that partly hidden
    training frames are used too. Where channels have several units, degrees and radians count as
    degrees, and mm, cm and m as the CMU database's unit of length, 5.64 cm. A wholly hidden frame
    is first interpolated linearly in time, and the interpolated frame is matched. There is no
    predictive distribution.

    Parameters
    ----------
    weights : mapping of str to float or None, default=None
        What the differences of a channel are multiplied by, at least 0, for every channel; None
        stands for 1. Where channels have several units, these are differences in degrees or 5.64
        cm, as above, so that the weights do not depend on which units they are. The standard
        deviations by which channels were divided give the distance in the units that they had
        before.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    frames_ : ndarray of shape (M, D)
        All training frames in the channels' units, NaN where hidden.
    weights_ : ndarray of shape (D,)
        What differences in the channel's unit are multiplied by: its weight times the factor, if
        there are several units, that turns radians into degrees, or mm, cm or m into 5.64 cm.

    Notes
    -----
    With :math:`V_{ti}` the channels visible both in frame t and in training frame i, and weights
    :math:`w_d` (``weights_``), channel d is copied from

    .. math::

        \arg\min_{i :\, Y_{id}\ \text{visible}} \frac{1}{|V_{ti}|}
        \sum_{e \in V_{ti}} w_e^2 (y_{te} - Y_{ie})^2

    References
    ----------
    W. Pan and L. Torresani (2009), Unsupervised Hierarchical Modeling of Locomotion Styles, ICML,
    §4.3, "NN".

    G. W. Taylor, G. E. Hinton and S. T. Roweis (2007), Modeling Human Motion Using Binary Latent
    Variables, NIPS 19: the nearest-neighbour baseline that the former cite.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import NN
    >>> from mocapbench.datasets import Recording
    >>> def poses(name, values):
    ...     return Recording(name, np.arange(len(values)), values, ("hip", "knee"), ("deg",) * 2)
    >>> training = poses("training", [[0.0, 10.0], [5.0, 20.0], [9.0, 30.0]])
    >>> (prediction,) = NN().fit([training]).impute([poses("new", [[4.0, np.nan], [8.0, np.nan]])])
    >>> prediction.mean
    array([[ 4., 20.],
           [ 8., 30.]])
    """

    family: ClassVar[str] = "Neighbours"
    provides: ClassVar[frozenset[str]] = Imputer.provides | Inductive.provides | {"scales along"}

    max_frames: ClassVar[int | None] = 4000

    def __init__(self, weights: Mapping[str, float] | None = None) -> None:
        self.weights = weights

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Keep the frames.

        Raises
        ------
        ValueError
            If there is no recording, channels differ, a name repeats, or ``weights`` has not one
            number of at least 0 for each channel.
        """
        checked = by_content(check_recordings(recordings))
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        self.frames_: FrameByChannel = stack(checked)
        self.weights_: Array = _weights(self.weights, self.channels_) * pose_factors(self.units_)
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return each recording with hidden entries copied from the nearest training frames.

        Raises
        ------
        ValueError
            If channels differ, or a hidden entry's channel is visible in no training frame that
            shares a visible channel with the frame to fill.
        """
        check_is_fitted(self)
        check_channels(recordings, self.channels_, self.units_)
        return [
            Prediction.around(recording, self._fill_recording(recording))
            for recording in recordings
        ]

    def _fill_recording(self, recording: Recording) -> FrameByChannel:
        filled = recording.values.copy()
        incomplete = ~recording.visible.all(axis=1)
        if not incomplete.any():
            return filled
        poses = _poses(recording)[incomplete]
        distances = nan_euclidean_distances(poses * self.weights_, self.frames_ * self.weights_)
        distances = np.where(np.isnan(distances), np.inf, distances)
        filled[incomplete] = np.column_stack([_donate_values(distances, c) for c in self.frames_.T])
        if (lacking := np.isnan(filled) & ~recording.visible).any():
            channels = [recording.channels[d] for d in np.flatnonzero(lacking.any(axis=0))]
            raise ValueError(
                f"recording {recording.name!r}: expected a training frame in which {channels} and "
                "a channel visible here are both visible, got none; train on more complete "
                "recordings"
            )
        return filled


def _weights(weights: Mapping[str, float] | None, channels: tuple[str, ...]) -> Array:
    """Return the weight of each channel: (D,)."""
    if weights is None:
        return np.ones(len(channels))
    if not isinstance(weights, Mapping):
        raise ValueError(
            f"expected weights to be None or a mapping of channels to numbers, got {weights!r}"
        )
    if lacking := [name for name in channels if name not in weights]:
        raise ValueError(f"expected a weight of every channel, got none of {lacking}")
    for name in channels:
        check_not_negative(f"weights of {name!r}", weights[name])
    return np.array([weights[name] for name in channels], dtype=np.float64)


def _donate_values(distances: Array, channel: Array) -> Array:
    """Return the values of a channel (M,) at the least of its ``distances`` (n, M): (n,).

    Frames in which the channel is hidden are left out; NaN if no frame remains.
    """
    usable = np.where(np.isnan(channel), np.inf, distances)
    return np.where(np.isinf(usable.min(axis=1)), np.nan, channel[usable.argmin(axis=1)])


def _poses(recording: Recording) -> FrameByChannel:
    """Return the values with wholly hidden frames interpolated linearly in time."""
    poses = recording.values.copy()
    blank = ~recording.visible.any(axis=1)
    poses[blank] = interpolate_channels(recording.values, recording.times, recording.times[blank])
    return poses
