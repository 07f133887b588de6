"""Outputs in a common unit: of zero mean and unit variance, over all recordings or within each.

People differ in their mean posture by more than they move in some channels. What one channel tells
about another within a motion is therefore learnt from deviations from recordings' own means.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.checks import check_known, check_spread, check_visible
from mocapbench.baselines.common.recordings import visible_moments
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["OwnMeans", "Standardisation", "is_constant", "unit_scales"]


_CONSTANT = 1e-12
"""Relative standard deviation below which an output counts as constant: it is rounding error."""


@dataclass(frozen=True, eq=False)
class Standardisation:
    """The map z = (y − mean) / scale of each output.

    Parameters
    ----------
    mean, scale : ndarray of shape (D,)
        Mean and standard deviation (ddof 0) of the visible entries; a constant output has scale 1.
    counts : ndarray of shape (D,)
        Number of visible entries.
    """

    mean: Array
    scale: Array
    counts: Array

    @classmethod
    def of(cls, recordings: Sequence[Recording]) -> Standardisation:
        """Return the map for recordings with the same channels.

        Raises
        ------
        ValueError
            If an output is nowhere visible, or in one entry only.
        """
        check_visible(recordings)
        check_spread(recordings)
        mean, variance = visible_moments(recordings)
        counts = np.sum([recording.visible.sum(axis=0) for recording in recordings], axis=0)
        return cls(mean, np.where(is_constant(mean, variance), 1.0, np.sqrt(variance)), counts)

    def apply(self, recording: Recording) -> Recording:
        """Return the recording in standard units."""
        return recording.with_values((recording.values - self.mean) / self.scale)

    def restore(self, values: FrameByChannel) -> FrameByChannel:
        """Return ``values`` (…, N, D) in standard units in the outputs' own units."""
        return values * self.scale + self.mean

    @property
    def log_jacobian(self) -> float:
        """The log-Jacobian of the change of units, −Σ_d n_d log scale_d.

        It is added to the log-density of data in standard units to get that in their own units.
        """
        return -float(self.counts @ np.log(self.scale))


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
        deviations = [recording.with_values(_deviate(recording)) for recording in recordings]
        _, variance = visible_moments(deviations)
        return cls(mean, np.where(is_constant(mean, variance), 1.0, np.sqrt(variance)))

    def apply(self, recording: Recording) -> FrameByChannel:
        """Return the deviations (N, D) of a recording in units of ``scale``; NaN where hidden."""
        return _deviate(recording) / self.scale

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


def unit_scales(recordings: Sequence[Recording]) -> Array:
    """Return the scale of each channel (D,): the mean spread of the channels of its unit.

    That is the root of the mean variance of their visible entries; 1 if they are constant. With
    one unit, errors are those in it up to a factor; with several, each counts alike.
    """
    mean, variance = visible_moments(recordings)
    spread = np.where(is_constant(mean, variance), 0.0, np.nan_to_num(variance))
    units = np.array(recordings[0].units)
    of_unit = np.array([spread[units == unit].mean() for unit in recordings[0].units])
    return np.sqrt(np.where(of_unit > 0.0, of_unit, 1.0))


def is_constant(mean: Array, variance: Array) -> NDArray[np.bool_]:
    """Return which channels (D,) vary by no more than rounding, or have no visible entry."""
    return np.asarray(~(np.sqrt(variance) > _CONSTANT * np.maximum(np.abs(mean), 1.0)))


def _deviate(recording: Recording) -> FrameByChannel:
    own, _ = visible_moments([recording])
    return np.asarray(recording.values - own)
