r"""A gap of one marker, filled by what the markers around it show of it.

The marker is seen from a body that moves with the others. It is in every frame where the rotation
:math:`R_t` (row vectors) and the centre :math:`c_t` fit its mean shape best to the markers
:math:`p_k(t)` that hold it, with weights :math:`w_k`. What is at x in the room is at
:math:`(x - c_t) R_t^\top` as seen from it. Markers on a line do not fix the rotation about it; the
body then follows the line, and does not rotate about it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mocapbench.baselines.common.rigid import (
    FEWEST,
    find_rotations,
    least_rotations,
    spans_a_body,
)
from mocapbench.baselines.kriging.described_frames import (
    DescribedFrames,
    choose_evenly,
    choose_from_both,
    choose_near,
)
from mocapbench.baselines.kriging.marker_process import learn_marker_process, predict_marker
from mocapbench.basics.arrays import Array, Index

__all__ = ["MarkerGap", "fit_body", "to_body", "to_room"]


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
_ROUNDING = 1e-6
"""Deviations, relative to the distance from the markers around, that count as none."""
_SHAPE_ROUNDS = 3
"""Times that the mean shape is fitted anew; it hardly moves after the first."""


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
        rotations, centres, shapes = fit_body(stacked[:, 1:], self.steady**self.power)
        seen = to_body(stacked[:, 0], rotations, centres)[known]
        centre = seen.mean(axis=0)
        spread = max(np.sqrt(np.mean((seen - centre) ** 2)), _ROUNDING * np.abs(shapes).max())
        values = (seen - centre) / spread
        mean, variance = self._predict_gap(self._describe_frames(self._rows, shapes), values)
        gap = slice(len(self.frames))
        filled = to_room(centre + spread * mean, rotations[gap], centres[gap])
        return filled, spread**2 * variance[:, None]

    def _predict_gap(self, frames: DescribedFrames, values: Array) -> tuple[Array, Array]:
        """Return the moments in the gap, with which ``frames`` begin, given ``values`` after it."""
        wanted, known = np.split(np.arange(len(self._rows)), [len(self.frames)])
        some = choose_from_both(self._given[:, 0], 0, _LEARNT)
        process = learn_marker_process(frames.at(known[some]), values[some], self._seconds)
        return predict_marker(frames.at(known), values, frames.at(wanted), *process)

    def _describe_frames(self, rows: Index, shapes: Array) -> DescribedFrames:
        """Describe frames by shapes (n, K, 3), scaled to variance 1; steady markers count more."""
        changes = self.steady[:, None] * (shapes - shapes.mean(axis=0))
        size = np.sqrt((changes**2).sum(axis=(1, 2)).mean())
        changes /= max(size, _ROUNDING * np.abs(shapes).max())
        times = np.array([self.times[number][frame] for number, frame in rows])
        return DescribedFrames(changes.reshape(len(changes), -1), times, rows[:, 0])

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
        *_, shapes = fit_body(self._stack(rows)[:, 1:], self.steady**self.power)
        wanted, known = np.split(np.arange(len(rows)), [len(self.frames)])
        frames = self._describe_frames(rows, shapes)
        return choose_near(frames.at(known), frames.at(wanted), 0, _OTHERS)

    def _find_complete_frames(self, number: int) -> Index:
        places = self.places[number][:, [self.marker, *self.others]]
        frames = np.flatnonzero(~np.isnan(places).any(axis=(1, 2)))
        return np.column_stack([np.full_like(frames, number), frames])

    def _stack(self, rows: Index) -> Array:
        """Return the marker and the others (n, 1 + K, 3) in frames of recordings (n, 2)."""
        markers = [self.marker, *self.others]
        return np.array([self.places[number][frame, markers] for number, frame in rows])


def fit_body(places: Array, weights: Array) -> tuple[Array, Array, Array]:
    """Fit the body to markers in the room.

    Parameters
    ----------
    places : ndarray of shape (T, K, 3)
        At least three markers.
    weights : ndarray of shape (K,)
        Not negative.

    Returns
    -------
    rotations : ndarray of shape (T, 3, 3)
        From the body to the room, of row vectors.
    centres : ndarray of shape (T, 3)
        The weighted means of the markers.
    shapes : ndarray of shape (T, K, 3)
        The markers, as seen from the body.
    """
    shares = weights / weights.sum()
    centres = np.einsum("k,tki->ti", shares, places)
    around = places - centres[:, None]
    shape = around[len(around) // 2]
    for _ in range(_SHAPE_ROUNDS):
        rotations = find_rotations(shape, around, shares)
        shapes = np.einsum("tkj,tij->tki", around, rotations)
        shape = shapes.mean(axis=0)
    if not spans_a_body(shapes, shares):
        rotations = least_rotations(shape, around, shares)
        shapes = np.einsum("tkj,tij->tki", around, rotations)
    return rotations, centres, shapes


def to_body(places: Array, rotations: Array, centres: Array) -> Array:
    """Return a marker (T, 3) of the room as seen from the body."""
    return np.asarray(np.einsum("tj,tij->ti", places - centres, rotations))


def to_room(seen: Array, rotations: Array, centres: Array) -> Array:
    """Return a marker (T, 3) as seen from the body in the room."""
    return np.asarray(np.einsum("ti,tij->tj", seen, rotations) + centres)
