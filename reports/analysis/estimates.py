"""The means of a metric over the folds of a case, with their intervals and spreads."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from scipy.sparse import csr_array

from mocapbench.basics.arrays import Array
from mocapbench.metrics.entries import mean_over
from mocapbench.metrics.statistics import ALPHA, UnitMeans, unit_means
from mocapbench.reports.analysis.units import unit_names
from mocapbench.reports.bundle.layout import CaseLayout

__all__ = ["FoldMean", "estimates", "fold_table"]


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
        half = _keep_finite(float(found.half_widths(ALPHA)))
        return cls(float(np.mean(values)), two_sd, len(values), None, half)


def fold_table(scores: pd.DataFrame, column: str) -> pd.DataFrame:
    """Return a column of a task's scores by metric, label and case, with a column a fold.

    Parameters
    ----------
    scores : DataFrame
        The task's rows of the bundle's scores.
    column : str
        ``"value"`` or ``"sample_two_sd"``.

    Returns
    -------
    DataFrame
        NaN where there is none.
    """
    wide = scores.pivot(index=["metric", "label", "case"], columns="fold", values=column)
    return wide.astype(float)


def estimates(
    scores: pd.DataFrame, cases: Iterable[CaseLayout], *, independent: bool
) -> Mapping[tuple[str, str, str], FoldMean]:
    """Return every mean over the folds of a case, by (case, label, metric).

    Parameters
    ----------
    scores : DataFrame
        The task's rows of the bundle's scores.
    cases : iterable of CaseLayout
        Those of the scores, and maybe others.
    independent : bool
        Whether folds are independent draws.
    """
    folds, spreads = (fold_table(scores, column) for column in ("value", "sample_two_sd"))
    by_name, found = {case.name: case for case in cases}, {}
    for name, of_case in folds.groupby(level="case"):
        units = unit_names(by_name[str(name)], map(int, folds.columns), independent=independent)
        rows = _fold_means(of_case.to_numpy(), spreads.loc[of_case.index].to_numpy(), units)
        for (metric, label, case), row in zip(of_case.index, rows, strict=True):
            found[case, label, metric] = row
    return found


def _fold_means(values: Array, spreads: Array, units: Sequence[str]) -> list[FoldMean]:
    """Return the mean of each row of values, a column a fold, one or more of them finite."""
    over_units = _over_units(values, units)
    columns = (
        over_units.mean,
        2.0 * _deviation(values),
        np.isfinite(values).sum(axis=1),
        _mean(spreads),
        over_units.half_widths(ALPHA),
    )
    return [
        FoldMean(mean, _keep_finite(sd), n, _keep_finite(sample_sd), _keep_finite(half_width))
        for mean, sd, n, sample_sd, half_width in zip(*(c.tolist() for c in columns), strict=True)
    ]


def _over_units(folds: Array, units: Sequence[str]) -> UnitMeans:
    """Return the means over folds, each weighing the same, with the errors of means over units."""
    place = {unit: number for number, unit in enumerate(dict.fromkeys(units))}
    ones, places = np.ones(len(units)), (range(len(units)), [place[unit] for unit in units])
    unit_of = csr_array((ones, places), shape=(len(units), len(place)))
    present = np.isfinite(folds)
    counts = present.astype(float) @ unit_of
    sums = np.where(present, folds, 0.0) @ unit_of
    shares = counts / np.maximum(counts.sum(axis=-1, keepdims=True), 1.0)
    return unit_means(sums / np.maximum(counts, 1.0), shares)


def _mean(values: Array) -> Array:
    """Return the means over the last axis of what is finite, NaN where nothing is."""
    return mean_over(values, np.isfinite(values), axis=-1)


def _deviation(values: Array) -> Array:
    """Return the standard deviations (ddof 1) over the last axis, NaN for fewer than two."""
    finite = np.isfinite(values)
    n = finite.sum(axis=-1)
    squares = np.where(finite, values - _mean(values)[..., None], 0.0) ** 2
    return np.where(n > 1, np.sqrt(squares.sum(axis=-1) / np.maximum(n - 1, 1)), np.nan)


def _keep_finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
