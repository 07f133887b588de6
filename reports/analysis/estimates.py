"""The means over folds of a whole task, by case, label and metric."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping

import numpy as np
from scipy.sparse import csr_array

from mocapbench.basics.arrays import Array
from mocapbench.metrics.entries import mean_over
from mocapbench.metrics.statistics import ALPHA, UnitMeans, unit_means
from mocapbench.reports.analysis.fold_mean import FoldMean
from mocapbench.reports.analysis.grid import Grid
from mocapbench.reports.analysis.units import unit_names
from mocapbench.reports.bundle.layout import CaseLayout

__all__ = ["estimates"]


def estimates(
    grid: Grid, cases: Iterable[CaseLayout], *, independent: bool
) -> Mapping[tuple[str, str, str], FoldMean]:
    """Return every mean over the folds of a case, by (case, label, metric).

    Parameters
    ----------
    grid : Grid
    cases : iterable of CaseLayout
        Those of the grid, and maybe others.
    independent : bool
        Whether folds are independent draws.
    """
    by_name = {case.name: case for case in cases}
    return {
        address: mean
        for column, name in enumerate(grid.cases)
        for address, mean in _of_case(
            grid, column, unit_names(by_name[name], grid.folds, independent=independent)
        )
    }


def _of_case(
    grid: Grid, column: int, units: list[str]
) -> Iterator[tuple[tuple[str, str, str], FoldMean]]:
    folds = grid.values[:, :, column]
    n = np.isfinite(folds).sum(axis=-1)
    found = _over_units(folds, units)
    columns = (
        n,
        found.mean,
        2.0 * _deviation(folds),
        _mean(grid.sample_two_sd[:, :, column]),
        found.half_widths(ALPHA),
    )
    for m, label in np.argwhere(n > 0):
        count, mean, two_sd, sample_two_sd, half_width = (float(c[m, label]) for c in columns)
        address = (grid.cases[column], grid.labels[label], grid.metrics[m])
        yield (
            address,
            FoldMean(
                mean,
                _keep_finite(two_sd),
                int(count),
                _keep_finite(sample_two_sd),
                _keep_finite(half_width),
            ),
        )


def _over_units(folds: Array, units: list[str]) -> UnitMeans:
    """Return the means over folds, each weighing the same, with the errors of means over units."""
    place = {unit: number for number, unit in enumerate(dict.fromkeys(units))}
    ones, places = np.ones(len(units)), (range(len(units)), [place[unit] for unit in units])
    unit_of = csr_array((ones, places), shape=(len(units), len(place)))
    present = np.isfinite(folds)
    counts, sums = (
        (array.reshape(-1, len(units)) @ unit_of).reshape(*folds.shape[:-1], len(place))
        for array in (present.astype(float), np.where(present, folds, 0.0))
    )
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
