"""Means over folds and their intervals, on the scale that they are drawn on."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.reports.analysis.interval import half_widths
from mocapbench.reports.figures.scale import Scale

__all__ = ["centre", "interval"]


def centre(values: Sequence[float], scale: Scale) -> float:
    """Return the mean; on a logarithmic scale that of the logarithms, transformed back."""
    seen = scale.forward(np.array(values, dtype=float))
    return float(scale.backward(np.asarray(seen.mean())))


def interval(values: Sequence[float], scale: Scale) -> tuple[float, float] | None:
    """Return the 95 % interval of the mean by Student's t.

    Parameters
    ----------
    values : sequence of float
        One a fold, from independent folds.
    scale : Scale
        On a logarithmic scale it is the interval of the mean of logarithms, transformed back: it
        holds positive values only and lies around `centre`.

    Returns
    -------
    (float, float) or None
        None for a single fold.
    """
    if len(values) < 2:
        return None
    seen = scale.forward(np.array(values, dtype=float))
    low, high = scale.backward(seen.mean() + half_widths(seen) * np.array([-1.0, 1.0]))
    return float(low), float(high)
