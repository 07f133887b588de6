"""The mean of a metric over the folds of a case, with its interval and its spreads."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mocapbench.metrics.statistics import ALPHA, unit_means

__all__ = ["FoldMean"]


@dataclass(frozen=True)
class FoldMean:
    """A mean over folds.

    Parameters
    ----------
    mean : float
        Every fold weighs the same.
    two_sd : float or None
        Two standard deviations (ddof 1) over folds, as the papers print; None for a single fold.
    n : int
        Number of folds.
    sample_two_sd : float or None
        Two standard deviations (ddof 1) over the samples of a fold, averaged over folds; None
        where the values are not means over samples.
    half_width : float or None
        Half the 95 % interval of the mean by Student's t over units
        (`mocapbench.reports.analysis.units`): the ± of the page. None where there is one unit, such
        as a single fold, or windows of one recording.
    """

    mean: float
    two_sd: float | None
    n: int
    sample_two_sd: float | None = None
    half_width: float | None = None

    @classmethod
    def of(cls, values: Sequence[float]) -> FoldMean:
        """Return the mean of one or more finite values, one a fold, where folds are units."""
        two_sd = 2.0 * float(np.std(values, ddof=1)) if len(values) > 1 else None
        found = unit_means(values, np.full(len(values), 1.0 / len(values)))
        half = float(found.half_widths(ALPHA))
        return cls(
            float(np.mean(values)), two_sd, len(values), None, half if math.isfinite(half) else None
        )
