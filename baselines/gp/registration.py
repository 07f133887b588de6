r"""Registration of recordings in time, before a model that has them vary around one trend.

Two walkers seldom begin with the same step, nor walk at one pace. A hierarchy whose children share
the trend at equal *times* takes that difference for one of movement. An affine map of time removes
most of it. Recordings without hidden entries are moved onto the clock of the *reference*, the one
that has the most hidden entries, or the first if none has any:

.. math:: \tilde y_r(t) = y_r(t_0 + a_r + b_r (t - t_0)), \qquad
          (a_r, b_r) = \arg\min \operatorname{rms}_{t, d\ \text{visible}}
              \big( y_{\text{ref}} - \tilde y_r - c_r \big) / \sigma .

The mean difference :math:`c_r` of each channel is left to the model, and :math:`\sigma` is the
standard deviation of the channel. Between frames a cubic spline is taken; frames that fall outside
a recording are hidden. Nothing that is hidden in the reference takes part.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from types import MappingProxyType

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize

from mocapbench.baselines.common.recordings import visible_moments
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Frames, Recording

__all__ = ["REGISTRATIONS", "TimeMap", "keep_times", "register_affinely"]


SHIFTS = np.linspace(-0.3, 0.3, 25)
"""Shifts a that are tried first, in spans of the reference."""
LOG_PACES = np.linspace(-0.25, 0.25, 11)
"""Logarithms of the paces b that are tried first."""
LEAST_OVERLAP = 0.6
"""Least share of the reference's frames that a moved recording covers."""


@dataclass(frozen=True)
class TimeMap:
    """The map from times of the reference to those of a recording: start + b (t − origin).

    Parameters
    ----------
    origin, start : float
        In seconds; the recording's ``start`` is moved to the reference's ``origin``.
    pace : float
        Positive; how many of the recording's seconds pass in one of the reference's.
    """

    origin: float = 0.0
    start: float = 0.0
    pace: float = 1.0

    def to_recording(self, times: Frames) -> Frames:
        """Return the recording's times at ``times`` (N,) of the reference."""
        return self.start + self.pace * (times - self.origin)

    def to_reference(self, times: Frames) -> Frames:
        """Return the reference's times at ``times`` (N,) of the recording."""
        return self.origin + (times - self.start) / self.pace


Registered = tuple[Recording, TimeMap]
"""A recording as the model takes it, and the clock by which it was moved."""


def keep_times(recordings: Sequence[Recording]) -> tuple[Registered, ...]:
    """Return the recordings as they are."""
    return tuple((recording, TimeMap()) for recording in recordings)


def register_affinely(recordings: Sequence[Recording]) -> tuple[Registered, ...]:
    """Return the recordings with those that are complete moved onto the reference's clock.

    The reference is the one with the most hidden entries, of several the first given.
    """
    reference = max(recordings, key=lambda recording: int((~recording.visible).sum()))
    _, variance = visible_moments(recordings)
    scale = np.sqrt(np.where(variance > 0.0, variance, 1.0))
    return tuple(
        _register_recording(recording, reference, scale)
        if recording is not reference and recording.visible.all() and len(recording.times) > 1
        else (recording, TimeMap())
        for recording in recordings
    )


def _register_recording(recording: Recording, reference: Recording, scale: Array) -> Registered:
    """Return a complete recording at the reference's times, where it is most like it."""
    spline = CubicSpline(recording.times, recording.values)
    first, span = float(reference.times[0]), float(np.ptp(reference.times))

    def clock(warp: Array) -> TimeMap:
        return TimeMap(first, first + span * float(warp[0]), float(np.exp(warp[1])))

    def at(warp: Array) -> Array:
        times = clock(warp).to_recording(reference.times)
        inside = (times >= recording.times[0]) & (times <= recording.times[-1])
        return np.where(inside[:, None], spline(times), np.nan)

    def error(warp: Array) -> float:
        return _error(reference.values, at(warp), scale)

    # The best point of a grid, from which a simplex search refines: the error has many minima.
    start = min((np.array(warp) for warp in product(SHIFTS, LOG_PACES)), key=error)
    if np.isinf(error(start)):  # too short, or nothing of the reference is visible
        return recording, TimeMap()
    found = minimize(error, start, method="Nelder-Mead").x
    moved = replace(recording, times=reference.times, values=at(found))
    return moved, clock(found)


def _error(reference: Array, moved: Array, scale: Array) -> float:
    """Return the root mean square of the differences (N, D) about each channel's mean."""
    seen = ~np.isnan(reference) & ~np.isnan(moved)
    if not seen.any() or np.isnan(moved).any(axis=1).mean() > 1.0 - LEAST_OVERLAP:
        return np.inf
    differences = np.where(seen, reference - moved, 0.0) / scale
    means = differences.sum(axis=0) / np.maximum(seen.sum(axis=0), 1)
    return float(np.sqrt(np.square(differences - means)[seen].mean()))


REGISTRATIONS: Mapping[str, Callable[[Sequence[Recording]], Sequence[Registered]]] = (
    MappingProxyType({"none": keep_times, "affine": register_affinely})
)
"""The registrations by the name that `MOHGP` takes."""
