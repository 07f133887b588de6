"""The nearest training frame, copied where entries are hidden."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import numpy as np
from numpy.typing import NDArray
from sklearn.metrics.pairwise import nan_euclidean_distances
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.recordings import check_channels, check_recordings, stack
from mocapbench.baselines.protocols import Imputer, Inductive, Prediction
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["NN"]


Array = NDArray[np.float64]


class NN(Imputer, Inductive):
    """Copy hidden entries from the training frame that is nearest over the visible ones.

    Nearest in squared Euclidean distance over the entries that both frames show, per entry. A
    training frame donates only entries that it shows, so that frames of training which are hidden
    in part serve too. A frame with nothing visible is matched by the straight line in time between
    the visible entries of each channel. There is no predictive distribution.

    Attributes
    ----------
    channels_ : tuple of D str
        The channels of the recordings given to `fit`.
    frames_ : ndarray of shape (M, D)
        All training frames, NaN where hidden.

    References
    ----------
    HLM §4.3, "NN", after Taylor, Hinton and Roweis (2007), Modeling human motion using binary
    latent variables.
    """

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Keep the frames.

        Raises
        ------
        ValueError
            If there is no recording, channels differ, or a name repeats.
        """
        checked = check_recordings(recordings)
        self.channels_ = checked[0].channels
        self.frames_ = stack(checked)
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return each recording with what its frames lack copied from their nearest neighbours.

        Raises
        ------
        ValueError
            If channels differ, or no training frame shows an entry that is hidden together with
            one that is visible.
        """
        check_is_fitted(self)
        check_channels(recordings, self.channels_)
        return [Prediction.around(recording, self._filled(recording)) for recording in recordings]

    def _filled(self, recording: Recording) -> FrameByChannel:
        filled = recording.values.copy()
        incomplete = ~recording.visible.all(axis=1)
        if not incomplete.any():
            return filled
        distances = nan_euclidean_distances(_poses(recording)[incomplete], self.frames_)
        distances = np.where(np.isnan(distances), np.inf, distances)
        filled[incomplete] = np.column_stack([_donated(distances, c) for c in self.frames_.T])
        if (lacking := np.isnan(filled) & ~recording.visible).any():
            channels = [recording.channels[d] for d in np.flatnonzero(lacking.any(axis=0))]
            raise ValueError(
                f"recording {recording.name!r}: no training frame shows {channels} together with "
                "an entry that is visible here; train on more complete recordings"
            )
        return filled


def _donated(distances: Array, channel: Array) -> Array:
    """Return the visible values of a channel (M,) at the least distances (n, M); NaN if none."""
    reach = np.where(np.isnan(channel), np.inf, distances)
    return np.where(np.isinf(reach.min(axis=1)), np.nan, channel[reach.argmin(axis=1)])


def _poses(recording: Recording) -> FrameByChannel:
    """Return the values with frames that are hidden as a whole interpolated in time."""
    poses = recording.values.copy()
    blank = ~recording.visible.any(axis=1)
    for d in np.flatnonzero(recording.visible.any(axis=0)):
        seen = recording.visible[:, d]
        known = recording.times[seen], recording.values[seen, d]
        poses[blank, d] = np.interp(recording.times[blank], *known)
    return poses
