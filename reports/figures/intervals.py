"""Means over folds and their intervals, on the scale that they are drawn on."""

from __future__ import annotations

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.metrics.statistics import ALPHA, unit_means
from mocapbench.reports.analysis.units import FoldSample
from mocapbench.reports.figures.scale import Scale

__all__ = ["centre", "interval"]


def centre(sample: FoldSample, scale: Scale) -> float:
    """Return the mean; on a logarithmic scale that of the logarithms, transformed back."""
    seen = scale.forward(np.array(sample.values, dtype=float))
    return float(scale.backward(np.asarray(sample.weights.sum(axis=0) @ seen)))


def interval(sample: FoldSample, scale: Scale) -> tuple[float, float] | None:
    """Return the 95 % interval of the mean by Student's t over units.

    Parameters
    ----------
    sample : FoldSample
    scale : Scale
        On a logarithmic scale it is the interval of the mean of logarithms, transformed back: it
        holds positive values only and lies around `centre`.

    Returns
    -------
    (float, float) or None
        None for a single unit.
    """
    if sample.n_units < 2:
        return None
    seen = scale.forward(np.array(sample.values, dtype=float))
    shares: Array = sample.weights.sum(axis=1)
    sums: Array = np.asarray(sample.weights @ seen)
    found = unit_means(sums / shares, shares)
    low, high = scale.backward(found.mean + found.half_widths(ALPHA) * np.array([-1.0, 1.0]))
    return float(low), float(high)
