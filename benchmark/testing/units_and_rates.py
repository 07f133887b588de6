"""Checks of models that fill a motion alike in any unit and at any frame rate."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline

from mocapbench.basics.arrays import Array
from mocapbench.benchmark.testing.errors import require
from mocapbench.benchmark.testing.facing import load_marked_walks
from mocapbench.benchmark.testing.subject import COMPLETE, END, GAP, Subject, problem
from mocapbench.datasets import Mask, Recording

__all__ = ["fills_alike_in_any_unit", "fills_markers_alike_at_any_frame_rate"]

_UNITS = (("cm", "deg"), ("mm", "rad"))
"""The same channels in two pairs of units."""
_FACTORS = np.array([10.0, np.pi / 180.0])
"""Values in the second pair of units over those in the first."""
_ROUNDING = 1e-6
"""What a unit may change, in standard deviations of a channel."""
_RATES = (60.0, 100.0, 250.0)
_SECONDS, _GAP = 1.6, (0.5, 1.0)
"""How long walks are, and when their gap begins and ends: at frames of every rate."""
_SHARED = np.array([0.6, 0.7, 0.8, 0.9])
"""When all rates have a frame in the gap."""
_MOST = 0.02
"""What a frame rate may change, as a share of the error."""


def fills_alike_in_any_unit(subject: Subject) -> None:
    """Check that a motion is filled alike in other units of length and angle."""
    one, other = _UNITS
    here = _fill_in_units(subject, one, 1.0)
    there = _fill_in_units(subject, other, _FACTORS)
    spread = COMPLETE[-1].values.std(axis=0)
    gap = float(np.abs((there / _FACTORS - here) / spread).max())
    require(
        gap <= _ROUNDING,
        "the same fill in mm and rad as in cm and deg",
        f"one that differs by {gap:.2g} of a standard deviation",
        "measure each channel by its own spread, or leave out 'scales along'",
    )


def _fill_in_units(subject: Subject, units: tuple[str, ...], factors: Array | float) -> Array:
    hidden = GAP if "fills frames" in subject.build().provides else END
    given = [replace(one, values=one.values * factors, units=units) for one in problem(hidden)]
    (prediction,) = subject.fit_model(given).impute([given[-1]])
    return np.asarray(prediction.mean)


def fills_markers_alike_at_any_frame_rate(subject: Subject) -> None:
    """Check that markers are filled alike at more frames per second, training as it is."""
    *training, walk = load_marked_walks()
    model = subject.fit_model([_resample(each, 30.0) for each in training])
    here = _fill_at(model, walk, 30.0)
    truth = CubicSpline(walk.times, walk.values)(_SHARED)
    error = float(np.sqrt(np.mean((here - truth) ** 2)))
    for rate in _RATES:
        gap = float(np.sqrt(np.mean((_fill_at(model, walk, rate) - here) ** 2)))
        require(
            gap <= _MOST * error,
            f"the same fill of markers at {rate:g} frames per second as at 30",
            f"markers that differ by {gap / error:.2g} of their error",
            "count in seconds, or leave out 'resamples along'",
        )


def _fill_at(model: object, walk: Recording, rate: float) -> Array:
    """Return the fill (4, D) of a walk at the times that all rates share."""
    resampled = _resample(walk, rate)
    (prediction,) = model.impute([resampled.hide(_hide_gap(resampled))])  # type: ignore[attr-defined]
    return np.asarray(prediction.mean[np.round(rate * _SHARED).astype(int)])


def _resample(walk: Recording, rate: float) -> Recording:
    times = np.arange(round(_SECONDS * rate) + 1) / rate
    values = CubicSpline(walk.times, walk.values)(times)
    return Recording(walk.name, times, values, walk.channels, walk.units)


def _hide_gap(walk: Recording) -> Mask:
    start, end = _GAP
    hidden = (walk.times > start + 1e-9) & (walk.times < end - 1e-9)
    return np.repeat(hidden[:, None], walk.values.shape[1], axis=1)
