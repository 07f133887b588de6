"""The one rule of what counts as an independent unit, for every test and interval of the page.

A *cell* is a fold f of a case c. Its unit is

    u(c, f) = the subject s(c, f)   where the case has subjects,
              the fold (c, f)       else, where folds are independent draws of the protocol,
              the case c            else, as for overlapping windows of generated motion.

Let C(u) be the cases that have cells in a unit, and F(u, c) those cells of one case. The value of a
unit is the mean over its cases of the means over their cells,

    x(u) = Σ_c 1/|C(u)| Σ_f x(c, f)/|F(u, c)|,   c in C(u), f in F(u, c),

and every unit weighs the same in a mean. Two recordings of one subject are thus one unit. Where the
units are folds, and cases have equally many, the mean over units is the mean over cases.

With fewer than `FEWEST_UNITS` units no difference is tested: not to find one would say nothing.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from mocapbench.reports.bundle.layout import CaseLayout

__all__ = ["FEWEST_UNITS", "UnitKind", "unit_kind", "unit_names", "unit_weights"]

FEWEST_UNITS = 5


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


def unit_names(case: CaseLayout, folds: Sequence[int], *, independent: bool) -> list[str]:
    """Return the unit of each fold of a case."""
    match unit_kind(case, independent=independent):
        case UnitKind.SUBJECT:
            return [f"subject {case.subject(fold)}" for fold in folds]
        case UnitKind.FOLD:
            return [f"fold {fold} of {case.name}" for fold in folds]
        case UnitKind.CASE:
            return [f"case {case.name}"] * len(folds)


def unit_weights(units: Sequence[str], cases: Sequence[str]) -> NDArray[np.float64]:
    """Return the weights of cells in the values of units.

    Parameters
    ----------
    units, cases : sequence of str
        The unit and the case of each cell.

    Returns
    -------
    ndarray of shape (n_units, n_cells)
        Each row sums to 1. Units are in order of first appearance.
    """
    pairs = Counter(zip(units, cases, strict=True))
    n_cases = Counter(unit for unit, _ in pairs)
    rows = {unit: row for row, unit in enumerate(n_cases)}
    weights = np.zeros((len(rows), len(units)))
    for column, (unit, case) in enumerate(zip(units, cases, strict=True)):
        weights[rows[unit], column] = 1.0 / (n_cases[unit] * pairs[unit, case])
    return weights
