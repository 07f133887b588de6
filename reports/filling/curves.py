"""A filled channel around some of its gaps, and its drawing, in which gaps are shaded."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from markupsafe import Markup

from mocapbench.basics.arrays import Array
from mocapbench.basics.words import format_count
from mocapbench.reports.figures.axes import LEFT, TOP, WIDTH, draw_axes
from mocapbench.reports.figures.marks import band, group, horizontal, polyline, rectangle
from mocapbench.reports.figures.pictures.thinning import thin_points
from mocapbench.reports.figures.scale import Scale, fit_linear_scale
from mocapbench.reports.figures.styles import TRUTH, DrawingStyle
from mocapbench.reports.figures.svg_figure import Key, key

__all__ = [
    "FILLED_FRAMES",
    "GIVEN_FRAMES",
    "MOTION_STYLES",
    "FilledCurve",
    "draw_curve",
    "draw_legend",
]

FILLED_FRAMES, GIVEN_FRAMES = "filled", "in the file"
"""The groups of the figures of a motion: with filled entries, and without."""
HEIGHT = 120.0
FILLED = DrawingStyle("h0", 1)
MOTION_STYLES = {FILLED_FRAMES: FILLED}
"""Of the figures of a motion; those in the file are drawn as the truth is everywhere."""
_WITHIN_95 = 1.96


@dataclass(frozen=True, eq=False)
class FilledCurve:
    """A channel around some of its gaps.

    Parameters
    ----------
    channel, unit : str
    times : ndarray of shape (N,)
        Seconds.
    visible, filled : ndarray of shape (N,)
        Values that were there, and that the model put in; NaN where there are none.
    deviation : ndarray of shape (N,)
        Standard deviations of the filled values; NaN where there are none.
    gaps : tuple of (float, float)
        From when until when the channel was filled.
    """

    channel: str
    unit: str
    times: Array
    visible: Array
    filled: Array
    deviation: Array
    gaps: tuple[tuple[float, float], ...]


def draw_curve(curve: FilledCurve) -> Markup:
    """Return a channel as an SVG element."""
    half = _WITHIN_95 * curve.deviation
    low, high = curve.filled - half, curve.filled + half
    x = fit_linear_scale(curve.times, LEFT, WIDTH)
    values = np.concatenate([curve.visible, curve.filled, low, high])
    y = fit_linear_scale(values, TOP + HEIGHT, TOP)
    names = "time, s", curve.unit
    marks = [
        *(_shade_gap(x, *gap) for gap in curve.gaps),
        group(
            FILLED,
            band(x.places(curve.times), y.places(low), y.places(high)),
            _draw_line(x, y, curve.times, _join_neighbours(curve)),
        ),
        group(TRUTH, _draw_line(x, y, curve.times, curve.visible)),
    ]
    return draw_axes((x, y), curve.channel, names, marks, _describe_curve(curve))


def _describe_curve(curve: FilledCurve) -> str:
    gaps = format_count(len(curve.gaps), "filled gap")
    return f"{curve.channel} over time, with {gaps}"


def draw_legend() -> tuple[Key, ...]:
    """Return the keys that all curves share."""
    line = horizontal(0.0, 28.0, 7.0, "line")
    return (
        key("in the file", TRUTH, line),
        key("filled, with its 95 % interval if there is one", FILLED, line),
        key("gap", TRUTH, rectangle(0.0, 0.0, 28.0, 14.0, "shade")),
    )


def _shade_gap(x: Scale, first: float, last: float) -> str:
    """Return the shade of a gap, cut where the axis ends."""
    start, stop = (x.place(min(max(t, x.low), x.high)) for t in (first, last))
    return rectangle(start, TOP, stop - start, HEIGHT, "shade")


def _draw_line(x: Scale, y: Scale, times: Array, values: Array) -> str:
    return polyline(*thin_points(np.stack([x.places(times), y.places(values)], axis=1)).T)


def _join_neighbours(curve: FilledCurve) -> Array:
    """Return the filled values, joined to the visible ones beside them."""
    filled = ~np.isnan(curve.filled)
    beside = np.zeros_like(filled)
    beside[:-1] |= filled[1:]
    beside[1:] |= filled[:-1]
    return np.where(beside & ~filled, curve.visible, curve.filled)
