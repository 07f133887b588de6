"""Choose the scale that shows given values, and remark on it."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from mocapbench.reports.figures.scale import LinearScale, LogScale, Scale

__all__ = ["fit_linear_scale", "fit_scale", "remark"]

LOG_RANGE = 10.0
"""Ratio of the largest to the smallest value above which an axis is logarithmic."""
NARROW = 0.05
"""Share of its values below which the span of an axis deserves a remark."""
MARGIN = 0.04
"""Share of an axis that stays free beyond the outermost values."""


def fit_scale(values: Iterable[float], start: float, stop: float) -> Scale:
    """Return the scale that shows ``values``, logarithmic where they span more than a factor 10.

    Parameters
    ----------
    values : iterable of float
        Those that are not finite are passed over.
    start, stop : float
        Where the ends are, in pixels.
    """
    low, high = _range(values)
    kind = LogScale if low > 0.0 and high > LOG_RANGE * low else LinearScale
    return _around(kind, low, high, start, stop)


def fit_linear_scale(values: Iterable[float], start: float, stop: float) -> Scale:
    """Return the linear scale that shows ``values``; see `fit_scale`."""
    return _around(LinearScale, *_range(values), start, stop)


def _range(values: Iterable[float]) -> tuple[float, float]:
    finite = [value for value in values if math.isfinite(value)] or [0.0, 1.0]
    return min(finite), max(finite)


def _around(kind: type[Scale], low: float, high: float, start: float, stop: float) -> Scale:
    ends = kind.forward(np.array([low, high]))
    margin = MARGIN * float(ends[1] - ends[0]) or 0.05 * abs(low) or 1.0
    low, high = map(float, kind.backward(ends + np.array([-margin, margin])))
    return kind(low, high, start, stop)


def remark(scale: Scale) -> str:
    """Return a sentence on an axis that spans little of its values; empty on any other."""
    largest = max(abs(scale.low), abs(scale.high))
    share = (scale.high - scale.low) / largest
    return f"The axis spans {100.0 * share:.1g} % of the values." if share < NARROW else ""
