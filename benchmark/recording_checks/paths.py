"""Paths of markers, and of channels that are of none, and how far their steps are from usual."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd

from mocapbench.baselines.common.markers import marker_places, markers_of
from mocapbench.basics.arrays import Array, Mask
from mocapbench.datasets import Recording, frame_rate
from mocapbench.datasets.formats.missing_rows import count_missing_rows

__all__ = [
    "MotionPaths",
    "find_channel_paths",
    "find_marker_paths",
    "measure_extent",
]

_STEPS = 9
"""Steps around a step of which the median is what a marker would do."""
_SECONDS, _FRAMES, _QUANTILE = 0.5, 15, 0.9
"""On either side of a step, what its excess is compared with: that quantile, over these seconds or
frames, whichever is longer."""
_SHARE, _SHARE_OF_CHANNEL = 0.006, 0.1
"""The least leap of a marker, as a share of how far apart all are, and of a channel, as a share of
how far it moves."""
_LEAST_ANGLES = {"deg": 1.0, "rad": np.pi / 180}
"""The least leap of angles, in their unit, as some hardly move."""
_MOST = 0.1, 0.9
"""Quantiles between which a channel mostly is."""


@dataclass(frozen=True, eq=False)
class MotionPaths:
    """The paths of M markers, joints or other channels in N frames.

    Parameters
    ----------
    names : tuple of str
    positions : ndarray of shape (N, M, A)
        In A coordinates, all NaN where one is hidden.
    least_leaps : ndarray of shape (M,)
        How far steps of each are at least from those around them to be leaps. They are shares of
        how far apart all markers are, and of how far a channel moves, and so need no unit, which
        some files do not state.
    rate : float
        Frames per second; NaN if there is but one.
    missing_rows : ndarray of bool of shape (N - 1,)
        Behind which frames rows are missing.
    """

    names: tuple[str, ...]
    positions: Array
    least_leaps: Array
    rate: float
    missing_rows: Mask

    @cached_property
    def steps(self) -> Array:
        """How far each frame is from the one before (N - 1, M, A); NaN where rows are missing."""
        steps = np.diff(self.positions, axis=0)
        steps[self.missing_rows] = np.nan
        return steps

    @cached_property
    def excess(self) -> Array:
        """By how much each step differs from the median of those around it (N - 1, M, A)."""
        n_steps, n_markers, n_axes = self.steps.shape
        columns = pd.DataFrame(self.steps.reshape(n_steps, n_markers * n_axes))
        usual = columns.rolling(_STEPS, min_periods=1, center=True).median()
        return np.asarray(self.steps - usual.to_numpy().reshape(self.steps.shape))

    @cached_property
    def usual_excess(self) -> Array:
        """The size of the excess that most steps around each stay below (N - 1, M)."""
        half = max(_FRAMES, int(np.nan_to_num(self.rate) * _SECONDS))
        sizes = pd.DataFrame(np.linalg.norm(self.excess, axis=2))
        rolling = sizes.rolling(2 * half + 1, min_periods=1, center=True)
        return np.asarray(rolling.quantile(_QUANTILE))


def find_marker_paths(recording: Recording) -> MotionPaths:
    """Return the paths of the markers of a recording."""
    names = tuple(markers_of(recording.channels, recording.units))
    positions = recording.values[:, marker_places(recording.channels, recording.units)]
    hidden = np.isnan(positions).any(axis=2, keepdims=True)
    positions = np.where(hidden, np.nan, positions)
    least_leaps = np.full(len(names), _SHARE * measure_extent(positions))
    missing = count_missing_rows(len(positions), None, recording.times) > 0
    return MotionPaths(names, positions, least_leaps, frame_rate(recording), missing)


def find_channel_paths(recording: Recording) -> MotionPaths:
    """Return the paths of the channels that are of no marker, such as angles."""
    places = marker_places(recording.channels, recording.units)
    kept = np.setdiff1d(np.arange(len(recording.channels)), places)
    values = recording.values[:, kept]
    units = [recording.units[place] for place in kept]
    least_leaps = [
        _choose_least_leap(column[~np.isnan(column)], _LEAST_ANGLES.get(unit, 0.0))
        for column, unit in zip(values.T, units, strict=True)
    ]
    return MotionPaths(
        tuple(recording.channels[place] for place in kept),
        values[:, :, np.newaxis],
        np.array(least_leaps, dtype=np.float64),
        frame_rate(recording),
        count_missing_rows(len(values), None, recording.times) > 0,
    )


def measure_extent(positions: Array) -> float:
    """Return how far apart markers (N, M, 3) are: the median over frames of the diagonal of a box.

    Of a person it is about 1.9 m.
    """
    frames = ~np.isnan(positions[..., 0]).all(axis=1)
    if not frames.any():
        return 0.0
    low, high = np.nanmin(positions[frames], axis=1), np.nanmax(positions[frames], axis=1)
    return float(np.median(np.linalg.norm(high - low, axis=1)))


def _choose_least_leap(values: Array, least: float) -> float:
    """Return the least leap of a channel by how far apart most of its values (K,) are.

    A channel that stays the same in most steps, as a switch or a constant does, has no leaps.
    """
    if len(values) < _STEPS or np.median(np.abs(np.diff(values))) == 0.0:
        return np.inf
    return max(least, _SHARE_OF_CHANNEL * float(np.diff(np.quantile(values, _MOST))[0]))
