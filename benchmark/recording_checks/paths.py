"""Paths of markers, and of channels that are of none, and how far their steps are from usual."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd

from mocapbench.baselines.common.markers import marker_places, markers_of
from mocapbench.basics.arrays import Array, Index, Mask
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
_BLOCK = 4096
"""Frames that are looked at together, so that long recordings take no more memory."""
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
    def extent(self) -> float:
        """How far apart the markers are, see `measure_extent`."""
        return measure_extent(self.positions)

    def take_steps(self, frames: Index, markers: Index) -> Array:
        """Return how far markers go from frames to the next (..., A); NaN where rows are missing.

        Only what is asked for is computed, as a long recording has millions of steps.
        """
        steps = self.positions[frames + 1, markers] - self.positions[frames, markers]
        return np.where(self.missing_rows[frames][..., None], np.nan, steps)

    def measure_excess(self, markers: Index) -> Array:
        """Return how much steps of m markers differ from the median around each (N - 1, m, A)."""
        steps = np.diff(self.positions[:, markers], axis=0)
        steps[self.missing_rows] = np.nan
        n_steps, n_markers, n_axes = steps.shape
        columns = pd.DataFrame(steps.reshape(n_steps, n_markers * n_axes))
        usual = columns.rolling(_STEPS, min_periods=1, center=True).median()
        return np.asarray(steps - usual.to_numpy().reshape(steps.shape))

    @cached_property
    def sizes(self) -> Array:
        """The size of the excess of each step (N - 1, M)."""
        sizes = np.empty((len(self.missing_rows), len(self.names)))
        for marker in range(len(self.names)):
            excess = self.measure_excess(np.array([marker]))
            sizes[:, marker] = np.linalg.norm(excess[:, 0], axis=1)
        return sizes

    @cached_property
    def usual_sizes(self) -> Array:
        """The size that most steps around each stay below (N - 1, M).

        It is NaN for markers of which no step is large enough to be a leap.
        """
        half = max(_FRAMES, int(np.nan_to_num(self.rate) * _SECONDS))
        usual = np.full(self.sizes.shape, np.nan)
        large = np.flatnonzero((self.sizes > self.least_leaps).any(axis=0))
        rolling = pd.DataFrame(self.sizes[:, large]).rolling(
            2 * half + 1, min_periods=1, center=True
        )
        usual[:, large] = rolling.quantile(_QUANTILE)
        return usual


def find_marker_paths(recording: Recording) -> MotionPaths:
    """Return the paths of the markers of a recording."""
    names = tuple(markers_of(recording.channels, recording.units))
    positions = recording.values[:, marker_places(recording.channels, recording.units)]
    positions[np.isnan(positions).any(axis=2)] = np.nan
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
    if not positions.size:
        return 0.0
    sizes = np.concatenate(
        [_measure_boxes(positions[at : at + _BLOCK]) for at in range(0, len(positions), _BLOCK)]
    )
    return float(np.median(sizes)) if len(sizes) else 0.0


def _measure_boxes(positions: Array) -> Array:
    """Return the diagonal of the box around markers (n, M, 3), in frames in which any is seen."""
    seen = positions[~np.isnan(positions[..., 0]).all(axis=1)]
    low, high = np.fmin.reduce(seen, axis=1), np.fmax.reduce(seen, axis=1)  # ignore NaN
    return np.asarray(np.linalg.norm(high - low, axis=1))


def _choose_least_leap(values: Array, least: float) -> float:
    """Return the least leap of a channel by how far apart most of its values (K,) are.

    A channel that stays the same in most steps, as a switch or a constant does, has no leaps.
    """
    if len(values) < _STEPS or np.median(np.abs(np.diff(values))) == 0.0:
        return np.inf
    return max(least, _SHARE_OF_CHANNEL * float(np.diff(np.quantile(values, _MOST))[0]))
