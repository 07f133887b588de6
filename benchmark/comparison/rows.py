"""Rows of a comparison: a metric of an entrant in one case, or in all cases of a task.

A side that lost a fold of a row is not tested there: the folds in which it succeeded may be the
easy ones.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import pandas as pd

from mocapbench.benchmark.comparison.units import units_of, with_advantages
from mocapbench.benchmark.results.bundle import metric_info
from mocapbench.benchmark.tasks.base import Task
from mocapbench.metrics.statistics import ALPHA, ROPE, Contrast, contrast, holm
from mocapbench.reports import ChangeVerdict

__all__ = ["POOLED", "Row", "case_rows", "correct_rows", "pooled_rows"]

POOLED = "all cases"

Folds = Mapping[str, pd.DataFrame]
"""By entrant, what `mocapbench.benchmark.comparison.folds.paired_folds` returns."""


@dataclass(frozen=True)
class Row:
    """One contrast: of one case, or of all cases of a task (`POOLED`).

    ``identical`` says whether both sides have the same value in every fold. Of ``folds`` that both
    were asked for, they lost ``first_lost`` and ``second_lost``; if any, there are means alone.
    ``t_p_holm`` and ``signed_rank_p_holm`` are corrected over the rows of one task and metric
    that are not identical, the pooled ones apart from those of single cases.
    """

    task: str
    metric: str
    entrant: str
    case: str
    contrast: Contrast
    identical: bool = False
    t_p_holm: float = math.nan
    signed_rank_p_holm: float = math.nan
    folds: int = 0
    first_lost: int = 0
    second_lost: int = 0

    @property
    def incomplete(self) -> bool:
        """Whether a side lost folds."""
        return self.first_lost + self.second_lost > 0

    @property
    def verdict(self) -> ChangeVerdict:
        """How the second side compares with the first, by the corrected t-test."""
        if self.incomplete:
            return ChangeVerdict.INCOMPLETE
        if self.identical:
            return ChangeVerdict.IDENTICAL
        if not self.contrast.tested:
            return ChangeVerdict.UNTESTED
        if self.t_p_holm > ALPHA:
            return ChangeVerdict.MAY_BE_CHANCE
        return ChangeVerdict.BETTER if self.contrast.advantage < 0.0 else ChangeVerdict.WORSE


def case_rows(task: Task, metric: str, folds: Folds, rope: float = ROPE) -> list[Row]:
    """Return a row for each entrant and case, by entrant, without correction."""
    return [
        _row(task, metric, (label, str(case)), of_case, rope)
        for label, own in folds.items()
        for case, of_case in own.groupby(level="case", sort=False)
    ]


def pooled_rows(task: Task, metric: str, folds: Folds, rope: float = ROPE) -> list[Row]:
    """Return a row for each entrant with several cases that count, without correction."""
    return [
        _row(task, metric, (label, POOLED), counted, rope)
        for label, own in folds.items()
        for counted in [_select_counted(task, own)]
        if counted.index.unique("case").size > 1
    ]


def correct_rows(rows: Sequence[Row]) -> list[Row]:
    """Return rows with p-values after Holm's correction over all of them that have a test.

    Rows with the same values on both sides need none: otherwise models that nobody has changed
    would hide what became of the one that was.
    """
    t, signed = (
        holm([math.nan if row.identical else getattr(row.contrast, test) for row in rows])
        for test in ("t_p", "signed_rank_p")
    )
    return [
        replace(row, t_p_holm=float(one), signed_rank_p_holm=float(other))
        for row, one, other in zip(rows, t, signed, strict=True)
    ]


def _row(task: Task, metric: str, cell: tuple[str, str], folds: pd.DataFrame, rope: float) -> Row:
    """Return the row of an entrant in a case; with means alone, if some of its folds are lost."""
    first, second = map(int, folds.isna().sum())
    found = _contrast(task, metric, folds.dropna(), rope)
    entrant, case = cell
    row = Row(
        task=task.name,
        metric=metric,
        entrant=entrant,
        case=case,
        contrast=found,
        folds=len(folds),
        first_lost=first,
        second_lost=second,
    )
    if row.incomplete:
        return replace(row, contrast=Contrast(found.n, found.first, found.second))
    return replace(row, identical=folds["first"].equals(folds["second"]))


def _contrast(task: Task, metric: str, pairs: pd.DataFrame, rope: float) -> Contrast:
    if pairs.empty:
        return Contrast(0)
    return contrast(units_of(task, with_advantages(pairs, metric_info(metric))), rope)


def _select_counted(task: Task, pairs: pd.DataFrame) -> pd.DataFrame:
    """Return the pairs that count over cases, by the rule that the report's tables follow."""
    generated = [case.name for case in task.cases if case.synthetic]
    averages = [case.name for case in task.cases if task.averages_references(case)]
    for apart in (generated, averages):
        others = pairs[~pairs.index.get_level_values("case").isin(apart)]
        pairs = pairs if others.empty else others
    return pairs
