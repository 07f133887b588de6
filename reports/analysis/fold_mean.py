"""The mean of a metric over folds, with its spread and interval."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import special

__all__ = ["FoldMean"]


@dataclass(frozen=True)
class FoldMean:
    """A mean over folds.

    Parameters
    ----------
    mean : float
    two_sd : float or None
        Two standard deviations (ddof 1) over folds; None for a single fold.
    n : int
        Number of folds.
    sample_two_sd : float or None
        Two standard deviations (ddof 1) over the samples of a fold, averaged over folds; None
        where the values are not means over samples.
    """

    mean: float
    two_sd: float | None
    n: int
    sample_two_sd: float | None = None

    @classmethod
    def of(cls, values: Sequence[float], sample_two_sds: Sequence[float] = ()) -> FoldMean:
        """Return the mean of one or more finite values, one a fold.

        Parameters
        ----------
        values : sequence of float
            One value per fold.
        sample_two_sds : sequence of float
            Two standard deviations of each value over its samples, NaN where it has none.
        """
        two_sd = 2.0 * float(np.std(values, ddof=1)) if len(values) > 1 else None
        over_samples = [spread for spread in sample_two_sds if math.isfinite(spread)]
        sample_two_sd = float(np.mean(over_samples)) if over_samples else None
        return cls(float(np.mean(values)), two_sd, len(values), sample_two_sd)

    @property
    def spread(self) -> float | None:
        """The ± of tables: two sd over samples where there are samples, else over folds."""
        return self.two_sd if self.sample_two_sd is None else self.sample_two_sd

    @property
    def half_width(self) -> float | None:
        """Half the 95 % interval of the mean by Student's t; None for a single fold.

        The interval assumes that folds are independent draws.
        """
        if self.two_sd is None:
            return None
        quantile = float(special.stdtrit(self.n - 1, 0.975))
        return quantile * 0.5 * self.two_sd / math.sqrt(self.n)
