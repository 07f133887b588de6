"""Recordings as deviations from their own means, in units of the spread within recordings.

People differ in their mean posture by more than they move in some channels. What one channel tells
about another within a motion is therefore learnt from deviations.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mocapbench.baselines.common.checks import check_known
from mocapbench.baselines.common.recordings import visible_moments
from mocapbench.baselines.common.scaling import is_constant
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["OwnMeans"]


@dataclass(frozen=True, eq=False)
class OwnMeans:
    """The map z = (y − own mean) / scale of each channel of a recording.

    A recording's own mean is that of the channel's visible entries in it; where there is none, it
    is the mean over all recordings.

    Parameters
    ----------
    mean : ndarray of shape (D,)
        Mean of the visible entries of all recordings; NaN where there is none.
    scale : ndarray of shape (D,)
        Root mean squared deviation of visible entries from their recordings' own means; 1 for a
        channel without deviations.
    """

    mean: Array
    scale: Array

    @classmethod
    def of(cls, recordings: Sequence[Recording]) -> OwnMeans:
        """Return the map for recordings with the same channels."""
        mean, _ = visible_moments(recordings)
        deviations = [recording.with_values(_deviations(recording)) for recording in recordings]
        _, variance = visible_moments(deviations)
        return cls(mean, np.where(is_constant(mean, variance), 1.0, np.sqrt(variance)))

    def apply(self, recording: Recording) -> FrameByChannel:
        """Return the deviations (N, D) of a recording in units of ``scale``; NaN where hidden."""
        return _deviations(recording) / self.scale

    def restore(self, recording: Recording, deviations: FrameByChannel) -> FrameByChannel:
        """Return ``deviations`` (N, D), in units of ``scale``, as values of the recording.

        Raises
        ------
        ValueError
            If a channel is visible neither here nor in the recordings of the map.
        """
        own, _ = visible_moments([recording])
        centre = np.where(np.isnan(own), self.mean, own)
        check_known(recording, ~np.isnan(centre))
        return centre + self.scale * deviations


def _deviations(recording: Recording) -> FrameByChannel:
    own, _ = visible_moments([recording])
    return np.asarray(recording.values - own)
