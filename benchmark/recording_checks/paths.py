"""Paths of markers, and of channels that are of none, and how far their steps are from usual."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, reduce

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
    "measure_lengths",
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
_ROUNDED = 1 - 1e-9
"""What an upper bound may lack by rounding."""
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

    @cached_property
    def may_leap(self) -> Mask:
        """Which steps (N - 1, M) may be leaps: those around each differ enough for that.

        No step differs more from the median around it than the least there from the largest.
        """
        may_leap = np.zeros((len(self.missing_rows), len(self.names)), dtype=bool)
        for at in range(0, len(may_leap), _BLOCK):
            spans = self._measure_spans(at, min(at + _BLOCK, len(may_leap)))
            may_leap[at : at + _BLOCK] = spans > _ROUNDED * self.least_leaps
        return may_leap

    def _measure_spans(self, start: int, stop: int) -> Array:
        """Return how far apart steps around each of [start, stop) are (stop - start, M)."""
        near = np.arange(start - _STEPS // 2, stop + _STEPS // 2)
        within = near.clip(0, len(self.missing_rows) - 1)
        steps = np.diff(self.positions[within[0] : within[-1] + 2], axis=0)[within - within[0]]
        steps[self.missing_rows[within] | (near != within)] = np.nan
        around = [steps[k : k + stop - start] for k in range(_STEPS)]
        spans = reduce(np.fmax, around) - reduce(np.fmin, around)  # which ignore NaN
        return measure_lengths(spans)

    def measure_excess(self, marker: int) -> Array:
        """Return how much steps of a marker differ from the median around each (N - 1, A).

        It is NaN further from all that may be leaps than what is usual is taken of: of millions of
        steps of a long recording, that are most.
        """
        near = _widen(self.may_leap[:, marker], self._n_beside)
        around = np.flatnonzero(_widen(near, _STEPS // 2))
        excess = np.full((len(near), self.positions.shape[2]), np.nan)
        if len(around):
            steps = self.take_steps(around, np.array(marker))
            usual = pd.DataFrame(steps).rolling(_STEPS, min_periods=1, center=True).median()
            excess[around] = steps - usual.to_numpy()
            excess[~near] = np.nan
        return excess

    @property
    def _n_beside(self) -> int:
        """How many steps on either side of one its excess is compared with."""
        return max(_FRAMES, int(np.nan_to_num(self.rate) * _SECONDS))

    @cached_property
    def sizes(self) -> Array:
        """The size of the excess of each step (N - 1, M), NaN where that is."""
        sizes = np.full(self.may_leap.shape, np.nan)
        for marker in np.flatnonzero(self.may_leap.any(axis=0)).tolist():
            sizes[:, marker] = measure_lengths(self.measure_excess(marker))
        return sizes

    @cached_property
    def usual_sizes(self) -> Array:
        """The size that most steps around each stay below (N - 1, M).

        It is NaN but for steps that may be leaps, and for markers of which none is large enough.
        """
        usual = np.full(self.sizes.shape, np.nan)
        for marker in np.flatnonzero((self.sizes > self.least_leaps).any(axis=0)).tolist():
            may_leap = self.may_leap[:, marker]
            near = np.flatnonzero(_widen(may_leap, self._n_beside))
            rolling = pd.Series(self.sizes[near, marker]).rolling(
                2 * self._n_beside + 1, min_periods=1, center=True
            )
            usual[near, marker] = rolling.quantile(_QUANTILE)
            usual[~may_leap, marker] = np.nan
        return usual


def _widen(mask: Mask, n_beside: int) -> Mask:
    """Return where a mask (N,) is True within so many entries."""
    counts, places = np.concatenate([[0], np.cumsum(mask)]), np.arange(len(mask))
    stops = (places + n_beside + 1).clip(max=len(mask))
    return np.asarray(counts[stops] > counts[(places - n_beside).clip(min=0)])


def find_marker_paths(recording: Recording) -> MotionPaths:
    """Return the paths of the markers of a recording."""
    names = tuple(markers_of(recording.channels, recording.units))
    places = marker_places(recording.channels, recording.units)
    positions = _take_positions(recording.values, places)
    least_leaps = np.full(len(names), _SHARE * measure_extent(positions))
    missing = count_missing_rows(len(positions), None, recording.times) > 0
    return MotionPaths(names, positions, least_leaps, frame_rate(recording), missing)


def _take_positions(values: Array, places: Index) -> Array:
    """Return the coordinates of markers (N, M, 3) at their places, all NaN where one is.

    They are a view of the values, which may be large, where these are the coordinates in order.
    """
    in_order = np.array_equal(places.ravel(), np.arange(values.shape[1]))
    shape = len(values), len(places), 3
    positions = values.reshape(shape) if in_order else values[:, places]
    x, y, z = np.isnan(np.moveaxis(positions, 2, 0))
    partly = (x | y | z) & ~(x & y & z)
    if partly.any():
        positions = positions.copy()
        positions[partly] = np.nan
    return positions


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


def measure_lengths(vectors: Array) -> Array:
    """Return the length of each vector (..., A), as `numpy.linalg.norm` does for many axes."""
    # A sum along an axis of three numbers takes several times as long.
    return np.asarray(np.sqrt(reduce(np.add, np.moveaxis(vectors * vectors, -1, 0))))


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
    of_marker = np.ascontiguousarray(seen.transpose(1, 0, 2))  # (M, n, 3), in which it is fast
    low, high = np.fmin.reduce(of_marker), np.fmax.reduce(of_marker)  # ignore NaN
    return measure_lengths(high - low)


def _choose_least_leap(values: Array, least: float) -> float:
    """Return the least leap of a channel by how far apart most of its values (K,) are.

    A channel that stays the same in most steps, as a switch or a constant does, has no leaps.
    """
    if len(values) < _STEPS or np.median(np.abs(np.diff(values))) == 0.0:
        return np.inf
    return max(least, _SHARE_OF_CHANNEL * float(np.diff(np.quantile(values, _MOST))[0]))
