"""The one rule of what counts as an independent unit, in the report and in ``compare``.

A *cell* is a fold f of a case c. Its unit is

    u(c, f) = the subject s(c, f)   where the case has subjects,
              the fold (c, f)       else, where folds are independent draws of the protocol,
              the case c            else, as for overlapping windows of generated motion.

Every case weighs the same in a mean, and so does every cell of a case: of C cases, a cell of a case
with F(c) cells has the weight w(c, f) = 1/(C F(c)). The share of a unit and its value are

    s(u) = Σ w(c, f),    x(u) = Σ w(c, f) x(c, f)/s(u),    over the cells of u,

so that the mean Σ s(u) x(u) is the mean over cases. Two recordings of one subject are thus one
unit. `mocapbench.metrics.statistics.means` has the standard error of the mean, its degrees of
freedom, and which units are too few to test. Where all units have the same share it is the usual
t-test over their values.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Self

import numpy as np
from scipy.sparse import csr_array

from mocapbench.reports.bundle.layout import CaseLayout

__all__ = ["FoldSample", "UnitKind", "unit_kind", "unit_names", "unit_weights"]


class UnitKind(StrEnum):
    """What the units of some cases are."""

    SUBJECT = "subject"
    FOLD = "fold"
    CASE = "case"


def unit_kind(case: CaseLayout, *, independent: bool) -> UnitKind:
    """Return what the units of a case are; ``independent`` says whether its folds are."""
    if case.subjects:
        return UnitKind.SUBJECT
    return UnitKind.FOLD if independent else UnitKind.CASE


def unit_names(case: CaseLayout, folds: Iterable[int], *, independent: bool) -> list[str]:
    """Return the unit of each fold of a case."""
    match unit_kind(case, independent=independent):
        case UnitKind.SUBJECT:
            return [f"subject {case.subject(fold)}" for fold in folds]
        case UnitKind.FOLD:
            return [f"fold {fold} of {case.name}" for fold in folds]
        case UnitKind.CASE:
            return [f"case {case.name}" for _ in folds]


def unit_weights(units: Sequence[str], cases: Sequence[str]) -> csr_array[np.float64]:
    """Return the weights w(c, f) of cells, each in the row of its unit.

    Parameters
    ----------
    units, cases : sequence of str
        The unit and the case of each cell.

    Returns
    -------
    sparse array of shape (n_units, n_cells)
        The sum of a row is the unit's share, that of all is 1. Units are in order of first
        appearance.
    """
    n_cells = Counter(cases)
    rows = {unit: row for row, unit in enumerate(dict.fromkeys(units))}
    weights = [1.0 / (len(n_cells) * n_cells[case]) for case in cases]
    places = [rows[unit] for unit in units], range(len(units))
    return csr_array((weights, places), shape=(len(rows), len(units)))


@dataclass(frozen=True, eq=False)
class FoldSample:
    """The values of a label, one a fold, with the weights of each in their mean.

    Parameters
    ----------
    values : tuple of float
        One a fold, n in all, each finite.
    weights : sparse array of shape (n_units, n)
        Of the folds, each in the row of its unit. Their sum is 1.
    """

    values: tuple[float, ...]
    weights: csr_array[np.float64]

    @classmethod
    def of(cls, values: Sequence[float], units: Sequence[str], cases: Sequence[str]) -> Self:
        """Return the sample of values whose units and cases are given."""
        return cls(tuple(values), unit_weights(units, cases))

    @property
    def n_units(self) -> int:
        """How many independent units there are."""
        return int(self.weights.shape[0])
