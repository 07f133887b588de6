"""The losses of a metric in some cases, cell by cell, and their means over units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from mocapbench.basics.arrays import Array
from mocapbench.metrics.statistics import ALPHA, unit_means
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.units import unit_kind, unit_names, unit_weights
from mocapbench.reports.bundle.layout import CaseLayout

__all__ = ["Cells", "cells"]


@dataclass(frozen=True, eq=False)
class Cells:
    """The scores of some labels in cells, where a cell is one fold of one case.

    Parameters
    ----------
    labels : tuple of str
        Labels with a score, in table order.
    values, losses : ndarray of shape (n_labels, n_cells)
        NaN where a label has no score. Lower losses are better.
    cases, units : tuple of str
        The case and the unit of each cell.
    unit : str
        What a unit is: ``"subject"``, ``"fold"``, ``"case"``; ``"unit"`` where they are of several
        kinds.
    """

    labels: tuple[str, ...]
    values: Array
    losses: Array
    cases: tuple[str, ...]
    units: tuple[str, ...]
    unit: str

    @cached_property
    def scored(self) -> NDArray[np.bool_]:
        """Whether a label has a score in a cell, of shape (n_labels, n_cells)."""
        return np.isfinite(self.values)

    @cached_property
    def best(self) -> int:
        """The row with the least mean loss among those with the most scores."""
        n_scores = self.scored.sum(axis=1)
        candidates = np.flatnonzero(n_scores == n_scores.max()).tolist()
        return int(min(candidates, key=self.mean_loss))

    @cached_property
    def complete(self) -> NDArray[np.bool_]:
        """Whether a label has a score wherever the best one has, of shape (n_labels,)."""
        return np.asarray((self.scored == self.scored[self.best]).all(axis=1))

    def weights(self, kept: NDArray[np.bool_]) -> csr_array[np.float64]:
        """Return the weights of the cells that are ``kept``, by unit, of shape (n_units, kept)."""
        address = kept.tobytes()
        if address not in self._weights:
            columns = np.flatnonzero(kept)
            self._weights[address] = unit_weights(
                [self.units[i] for i in columns], [self.cases[i] for i in columns]
            )
        return self._weights[address]

    def by_unit(self, array: Array, kept: NDArray[np.bool_]) -> Array:
        """Return the means x(u) of each label over ``kept`` cells, of shape (n_labels, n_units)."""
        weights = self.weights(kept)
        sums: Array = np.asarray(weights @ array[:, kept].T)
        return sums.T / weights.sum(axis=1)

    @cached_property
    def _weights(self) -> dict[bytes, csr_array[np.float64]]:
        return {}

    def mean(self, row: int) -> float:
        """Return the mean value of a label over its cases, each weighing the same."""
        return self._mean_over_cases(self.values, row)

    def mean_loss(self, row: int) -> float:
        """Return the mean loss of a label over its cases, each weighing the same."""
        return self._mean_over_cases(self.losses, row)

    def half_width(self, row: int) -> float:
        """Return half the 95 % interval of `mean` by Student's t over units; NaN of one unit."""
        kept = self.scored[row]
        shares: Array = self.weights(kept).sum(axis=1)
        values = self.by_unit(self.values[[row]], kept)
        return float(unit_means(values, shares).half_widths(ALPHA)[0])

    def _mean_over_cases(self, array: Array, row: int) -> float:
        kept = self.scored[row]
        return float(self.weights(kept).sum(axis=0) @ array[row, kept])

    def covers(self, label: str, other: str) -> bool:
        """Return whether ``label`` has a score wherever ``other`` has one."""
        one, two = (self.scored[self.labels.index(name)] for name in (label, other))
        return bool(one[two].all())

    def n_units(self, row: int) -> int:
        """Return in how many units a label has scores."""
        return int(self.weights(self.scored[row]).shape[0])

    def n_cases(self, row: int) -> int:
        """Return in how many cases a label has scores."""
        return len({self.cases[i] for i in np.flatnonzero(self.scored[row])})


def cells(
    results: TaskResults,
    metric: str,
    cases: Sequence[CaseLayout] | None = None,
    labels: Sequence[str] | None = None,
) -> Cells:
    """Return the cells that have any score of some cases and labels.

    Parameters
    ----------
    results : TaskResults
    metric : str
    cases : sequence of CaseLayout or None
        By default the representative ones.
    labels : sequence of str or None
        By default the ranked ones.
    """
    known = results.representative_cases(metric) if cases is None else cases
    scored = set(results.folds.index.get_level_values("case"))
    shown = [case for case in known if case.name in scored]
    folds, independent = results.fold_numbers, results.layout.independent_folds
    wanted = tuple(results.layout.ranked if labels is None else labels)
    values = results.values(metric, wanted, [case.name for case in shown])
    losses = results.metrics[metric].linear_losses(values)
    units = [unit for case in shown for unit in unit_names(case, folds, independent=independent)]
    shape = (len(wanted), len(units))
    of_cells = tuple(case.name for case in shown for _ in folds)
    kinds = {unit_kind(case, independent=independent).value for case in shown}
    kind = kinds.pop() if len(kinds) == 1 else "unit"
    values, losses = values.reshape(shape), losses.reshape(shape)
    return _without_empty(Cells(wanted, values, losses, of_cells, tuple(units), kind))


def _without_empty(whole: Cells) -> Cells:
    rows = np.flatnonzero(whole.scored.any(axis=1))
    columns = np.flatnonzero(whole.scored.any(axis=0))
    return Cells(
        tuple(whole.labels[i] for i in rows),
        whole.values[np.ix_(rows, columns)],
        whole.losses[np.ix_(rows, columns)],
        tuple(whole.cases[i] for i in columns),
        tuple(whole.units[i] for i in columns),
        whole.unit,
    )
