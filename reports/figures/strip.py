"""Strips: the drawing in one row of a table, every fold a tick, the mean a dot.

All strips of a column share one scale, which its head or foot shows by `strip_axis`.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from markupsafe import Markup, escape

from mocapbench.reports.analysis.units import FoldSample
from mocapbench.reports.figures.axes import format_tick
from mocapbench.reports.figures.intervals import centre, interval
from mocapbench.reports.figures.marks import dot, horizontal, text, vertical
from mocapbench.reports.figures.scale import Scale, fit_scale
from mocapbench.reports.figures.styles import DrawingStyle

__all__ = ["STRIP_HEIGHT", "STRIP_WIDTH", "strip", "strip_axis", "strip_scale"]

STRIP_WIDTH, STRIP_HEIGHT = 180.0, 20.0
"""As ``figures.css`` has them, in pixels."""
_EDGE = 8.0
_MIDDLE = STRIP_HEIGHT / 2.0
_TICK = 4.0


def strip_scale(values: Iterable[float]) -> Scale:
    """Return the scale of strips that show ``values``, ends of intervals among them or not."""
    return fit_scale(values, _EDGE, STRIP_WIDTH - _EDGE)


def strip(sample: FoldSample, scale: Scale, label: str, style: DrawingStyle) -> Markup:
    """Return the strip of one row, with the interval of the mean where there are several units.

    Parameters
    ----------
    sample : FoldSample
        On a logarithmic scale the dot is at its geometric mean.
    scale : Scale
        The interval is cut where it ends.
    label : str
        Accessible name, such as "knn, 5 folds".
    style : DrawingStyle
    """
    places = scale.places(np.array(sample.values, dtype=float))
    middle, ends = scale.place(centre(sample, scale)), interval(sample, scale)
    marks = [
        *([_interval(ends, scale)] if ends else []),
        *([vertical(places, _MIDDLE - _TICK, _MIDDLE + _TICK)] if len(places) > 1 else []),
        dot(middle, _MIDDLE, style.shape),
    ]
    return Markup(  # marks are numbers
        f'<svg class="strip {style.classes}"{style.model} role="img" aria-label="{escape(label)}">'
        f"{''.join(marks)}</svg>"
    )


def strip_axis(scale: Scale, label: str) -> Markup:
    """Return the axis of the strips, for the head or foot of their column."""
    ticks = scale.ticks(4)
    marks = [
        horizontal(scale.start, scale.stop, 4.0, "axis"),
        vertical(map(scale.place, ticks), 4.0, 8.0, "axis"),
        *(text(scale.place(tick), 18.0, format_tick(tick), "middle") for tick in ticks),
    ]
    return Markup(
        f'<svg class="strip" role="img" aria-label="{escape(label)}">{"".join(marks)}</svg>'
    )


def _interval(ends: tuple[float, float], scale: Scale) -> str:
    low, high = (min(max(end, scale.low), scale.high) for end in ends)
    return horizontal(scale.place(low), scale.place(high), _MIDDLE)
