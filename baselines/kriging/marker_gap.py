"""A gap of one marker, filled by what the markers around it show of it.

The marker is seen from a body that moves with the others. A frame is described by their shape, as
seen from the body, and by how this shape has just changed and is about to.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mocapbench.baselines.common.rigid import FEWEST
from mocapbench.baselines.kriging.body import MarkerBody, to_body, to_room
from mocapbench.baselines.kriging.described_frames import (
    DescribedFrames,
    choose_evenly,
    choose_from_both,
    choose_near,
)
from mocapbench.baselines.kriging.marker_process import learn_marker_process, predict_marker
from mocapbench.basics.arrays import Array, Index

__all__ = ["MarkerGap"]


_BESIDE = 30
"""Frames on both sides of a gap that all count."""
_FURTHER = 400
"""Frames of the recording that count besides, spread evenly."""
_OTHERS, _SEEN = 300, 1600
"""Frames of all other recordings that count: those most like the gap's, of as many as are seen.

Spread evenly they are few of any one recording. In thirty recordings of strangers that no task
tests the nearest err a twelfth less for a limb, a tenth less for five joints.
"""
_LEARNT = 120
"""Frames of each of these from which parameters are learnt."""
_AROUND = 1.0 / 15.0
"""Seconds: how the shape changes is seen from the shapes so long before and after a frame.

A swinging limb passes through the same shape both ways. In recordings of 24 people that no task
tests, errors are 4 to 7 % less for a limb (a quarter of a second and a second; geometric means over
people) and 11 % less for five joints in a second; in a quarter of one, 9 % more, or by chance.
"""
_ROUNDING = 1e-6
"""Deviations, relative to the distance from the markers around, that count as none."""


@dataclass(frozen=True, eq=False)
class MarkerGap:
    """Frames in which a marker of the first of several recordings is hidden.

    Parameters
    ----------
    times : sequence of ndarray, each of shape (N,)
        Of the recording to fill, and of those to learn from besides; in seconds.
    places : sequence of ndarray, each of shape (N, M, 3)
        Where their markers are; NaN where hidden.
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

    times: Sequence[Array]
    places: Sequence[Array]
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
        stacked = self._stack(self._rows)
        body = self._fit_body(stacked)
        rotations, centres, shapes = body.see(stacked[:, 1:])
        seen = to_body(stacked[:, 0], rotations, centres)[known]
        centre = seen.mean(axis=0)
        spread = max(np.sqrt(np.mean((seen - centre) ** 2)), _ROUNDING * np.abs(shapes).max())
        values = (seen - centre) / spread
        parts = np.stack([shapes, *self._list_changes(body, shapes)], axis=1)
        mean, variance = self._predict_gap(self._describe_frames(self._rows, parts), values)
        gap = slice(len(self.frames))
        filled = to_room(centre + spread * mean, rotations[gap], centres[gap])
        return filled, spread**2 * variance[:, None]

    def _predict_gap(self, frames: DescribedFrames, values: Array) -> tuple[Array, Array]:
        """Return the moments in the gap, with which ``frames`` begin, given ``values`` after it."""
        wanted, known = np.split(np.arange(len(self._rows)), [len(self.frames)])
        some = choose_from_both(self._given[:, 0], 0, _LEARNT)
        process = learn_marker_process(frames.at(known[some]), values[some], self._seconds)
        return predict_marker(frames.at(known), values, frames.at(wanted), *process)

    def _list_changes(self, body: MarkerBody, shapes: Array) -> Iterator[Array]:
        """Yield how other shapes (n, K, 3) were before, and will be after.

        What is known on one side only goes on evenly on the other; 0 where nothing is known.
        """
        before, after = (self._see_changes(body, shapes, way) for way in (-1, 1))
        for changes, others in ((before, after), (after, before)):
            yield np.nan_to_num(np.where(np.isnan(changes), -others, changes))

    def _see_changes(self, body: MarkerBody, shapes: Array, way: int) -> Array:
        """Return how other shapes are `_AROUND` earlier (-1) or later (1); NaN where unknown."""
        beside = self._find_beside(way)
        places = self._stack(beside)[:, 1:]
        known = ~np.isnan(places).any(axis=(1, 2)) & (beside != self._rows).any(axis=1)
        changes = np.full_like(shapes, np.nan)
        changes[known] = body.see(places[known])[2] - shapes[known]
        return changes

    def _find_beside(self, way: int) -> Index:
        """Return rows nearest to `_AROUND` earlier or later, but others; at an end, the same."""
        beside = self._rows.copy()
        for number in np.unique(beside[:, 0]):
            of_it, times = beside[:, 0] == number, self.times[number]
            frames, halfway = beside[of_it, 1], (times[1:] + times[:-1]) / 2.0
            near = np.searchsorted(halfway, times[frames] + way * _AROUND)
            steps = np.maximum(way * (near - frames), 1)
            beside[of_it, 1] = np.clip(frames + way * steps, 0, len(times) - 1)
        return beside

    def _describe_frames(self, rows: Index, parts: Array) -> DescribedFrames:
        """Describe frames by parts (n, P, K, 3), shapes and changes of these, each of variance 1.

        Steady markers count more.
        """
        least = _ROUNDING * np.abs(parts).max()
        parts = self.steady[:, None] * (parts - parts.mean(axis=0))
        sizes = np.sqrt((parts**2).sum(axis=(2, 3)).mean(axis=0))
        parts /= np.maximum(sizes, least)[:, None, None]
        times = np.array([self.times[number][frame] for number, frame in rows])
        return DescribedFrames(parts.reshape(*parts.shape[:2], -1), times, rows[:, 0])

    @property
    def _seconds(self) -> float:
        """Length of the gaps to hold out: twice the time between the frames beside this one."""
        times = self.times[0]
        before, after = max(self.frames[0] - 1, 0), min(self.frames[-1] + 1, len(times) - 1)
        return 2.0 * float(times[after] - times[before])

    @cached_property
    def _rows(self) -> Index:
        """The numbers of recordings and frames (n, 2): the gap, and what is known besides."""
        return np.concatenate([self._gap_rows, self._given])

    @property
    def _gap_rows(self) -> Index:
        return np.column_stack([np.zeros_like(self.frames), self.frames])

    @cached_property
    def _given(self) -> Index:
        """Recordings and frames that show the marker and the others; the first recording first."""
        shown = [self._find_complete_frames(number) for number in range(len(self.places))]
        # All frames near the gap, and others of this recording, and of the rest.
        own, further = shown[0], np.concatenate([shown[0][:0], *shown[1:]])
        beside = np.abs(own[:, 1] - np.clip(own[:, 1], self.frames[0], self.frames[-1])) <= _BESIDE
        own = own[beside | np.isin(np.arange(len(own)), choose_evenly(own[:, 0], _FURTHER))]
        seen = np.concatenate([own, further[choose_evenly(further[:, 0], _SEEN)]])
        return seen if len(further) <= _OTHERS else seen[self._choose_near(seen)]

    def _choose_near(self, seen: Index) -> Index:
        """Return the places of rows of this recording, and of others most like the gap."""
        rows = np.concatenate([self._gap_rows, seen])
        stacked = self._stack(rows)
        *_, shapes = self._fit_body(stacked).see(stacked[:, 1:])
        wanted, known = np.split(np.arange(len(rows)), [len(self.frames)])
        frames = self._describe_frames(rows, shapes[:, None])
        return choose_near(frames.at(known), frames.at(wanted), 0, _OTHERS)

    def _fit_body(self, stacked: Array) -> MarkerBody:
        return MarkerBody.fit(stacked[:, 1:], self.steady**self.power)

    def _find_complete_frames(self, number: int) -> Index:
        places = self.places[number][:, [self.marker, *self.others]]
        frames = np.flatnonzero(~np.isnan(places).any(axis=(1, 2)))
        return np.column_stack([np.full_like(frames, number), frames])

    def _stack(self, rows: Index) -> Array:
        """Return the marker and the others (n, 1 + K, 3) in frames of recordings (n, 2)."""
        markers = [self.marker, *self.others]
        return np.array([self.places[number][frame, markers] for number, frame in rows])
