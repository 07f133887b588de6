"""A gap of one marker, filled by what the markers around it show of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mocapbench.baselines.common.rigid import FEWEST
from mocapbench.baselines.kriging.learning import evenly, some_of_both
from mocapbench.baselines.kriging.local_frames import LocalFrames
from mocapbench.baselines.kriging.marker_process import MarkerFrames, MarkerProcess
from mocapbench.basics.arrays import Array, Index

__all__ = ["MarkerGap", "Track"]


_BESIDE = 30
"""Frames on both sides of a gap that all count."""
_FURTHER = 400
"""Frames that count besides, spread evenly, of the recording; and as many of all the others."""
_LEARNT = 120
"""Frames of each of these from which parameters are learnt."""
_ROUNDING = 1e-6
"""Deviations, relative to the distance from the markers around, that count as none."""


@dataclass(frozen=True, eq=False)
class Track:
    """The markers of a recording.

    Parameters
    ----------
    times : ndarray of shape (N,)
        In seconds.
    places : ndarray of shape (N, M, 3)
        NaN where hidden.
    """

    times: Array
    places: Array


@dataclass(frozen=True, eq=False)
class MarkerGap:
    """Frames in which a marker of the first of several recordings is hidden.

    Parameters
    ----------
    tracks : sequence of Track
        The recording to fill, and those to learn from besides.
    marker : int
    frames : ndarray of int, shape (T,)
        Successive frames of the gap.
    others : ndarray of int, shape (K,)
        Markers that are visible throughout the gap.
    steady : ndarray of shape (K,)
        How steady the distance to each of them is; positive.
    power : float
        Exponent of the steadiness in the weight of a marker.
    """

    tracks: Sequence[Track]
    marker: int
    frames: Index
    others: Index
    steady: Array
    power: float

    @property
    def can_be_filled(self) -> bool:
        """Whether others hold a body, beside which the marker is visible twice somewhere."""
        return len(self.others) >= FEWEST and len(self._given) > 1

    def fill(self) -> tuple[Array, Array]:
        """Return the mean (T, 3) and the variance (T, 1) of the marker in the gap."""
        known = slice(len(self.frames), None)
        body = LocalFrames.of(self._stacked[:, 1:], self.steady**self.power)
        seen = body.to_body(self._stacked[:, 0])[known]
        centre = seen.mean(axis=0)
        spread = max(np.sqrt(np.mean((seen - centre) ** 2)), _ROUNDING * np.abs(body.shapes).max())
        values = (seen - centre) / spread
        mean, variance = self._predict_gap(self._describe_frames(body), values)
        hidden = np.arange(len(self.frames))
        return body.to_room(centre + spread * mean, hidden), spread**2 * variance[:, None]

    def _predict_gap(self, frames: MarkerFrames, values: Array) -> tuple[Array, Array]:
        """Return the moments in the gap, with which ``frames`` begin, given ``values`` after it."""
        wanted, known = np.split(np.arange(len(self._rows)), [len(self.frames)])
        some = some_of_both(self._given[:, 0] == 0, _LEARNT)
        process = MarkerProcess.learnt(frames.at(known[some]), values[some], self._seconds)
        return process.predict(frames.at(known), values, frames.at(wanted))

    def _describe_frames(self, body: LocalFrames) -> MarkerFrames:
        shapes = self.steady[:, None] * (body.shapes - body.shapes.mean(axis=0))
        size = np.sqrt((shapes**2).sum(axis=(1, 2)).mean())
        shapes /= max(size, _ROUNDING * np.abs(body.shapes).max())
        times = np.array([self.tracks[number].times[frame] for number, frame in self._rows])
        return MarkerFrames(shapes.reshape(len(shapes), -1), times, self._rows[:, 0])

    @property
    def _seconds(self) -> float:
        """Length of the gaps to leave out: twice the time between the frames beside this one."""
        times = self.tracks[0].times
        before, after = max(self.frames[0] - 1, 0), min(self.frames[-1] + 1, len(times) - 1)
        return 2.0 * float(times[after] - times[before])

    @cached_property
    def _rows(self) -> Index:
        """The numbers of recordings and frames (n, 2): the gap, and what is known besides."""
        gap = np.column_stack([np.zeros_like(self.frames), self.frames])
        return np.concatenate([gap, self._given])

    @cached_property
    def _given(self) -> Index:
        """Recordings and frames that show the marker and the others; the first recording first."""
        shown = [self._find_complete_frames(number) for number in range(len(self.tracks))]
        own, further = shown[0], np.concatenate([shown[0][:0], *shown[1:]])
        beside = np.abs(own[:, 1] - np.clip(own[:, 1], self.frames[0], self.frames[-1])) <= _BESIDE
        own = np.unique(np.concatenate([evenly(own, _FURTHER), own[beside]]), axis=0)
        return np.concatenate([own, evenly(further, _FURTHER)])

    def _find_complete_frames(self, number: int) -> Index:
        places = self.tracks[number].places[:, [self.marker, *self.others]]
        frames = np.flatnonzero(~np.isnan(places).any(axis=(1, 2)))
        return np.column_stack([np.full_like(frames, number), frames])

    @cached_property
    def _stacked(self) -> Array:
        """(n, 1 + K, 3) the marker and the others."""
        markers = [self.marker, *self.others]
        return np.array(
            [self.tracks[number].places[frame, markers] for number, frame in self._rows]
        )
