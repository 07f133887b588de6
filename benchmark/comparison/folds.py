"""The folds that both sides were asked for, with the values of a metric; NaN where one is lost.

A side *loses* a fold if its job has no result, if the metric or all of the job failed, or if its
value is not finite, as that of a model that diverged.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from mocapbench.benchmark.comparison.sides import Side
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address

__all__ = ["Pair", "both_scored", "paired_folds", "records_by_address"]

Fold = tuple[str, int | None]
Pair = tuple[Record, Record]
"""The records of one job on both sides."""


def records_by_address(side: Side, tasks: Sequence[str]) -> dict[Address, Record]:
    """Return the records of ``tasks`` by address, whose version `differences` compares.

    Jobs whose recordings are not on the machine say nothing of a model, and are left out.
    """
    return {
        record.address._replace(version=0): record
        for record in side
        if record.status is not Status.DATA_MISSING and (not tasks or record.address.task in tasks)
    }


def both_scored(pair: Pair) -> bool:
    """Return whether both jobs have scores, be it that a metric failed."""
    return all(record.scores for record in pair)


def paired_folds(task: str, metric: str, common: Mapping[Address, Pair]) -> dict[str, pd.DataFrame]:
    """Return the folds of a metric, for each entrant of a task.

    Parameters
    ----------
    task, metric : str
    common : mapping of Address to pair of Record
        The jobs that both sides were asked for.

    Returns
    -------
    dict of str to DataFrame
        By label: columns ``first`` and ``second``, indexed by (case, fold). Finite, or NaN where
        that side lost the fold. Folds in which the metric is not defined are left out, and all of
        an entrant for one side of which it never is.
    """
    by_label: dict[str, dict[Fold, Pair]] = {}
    for address, pair in common.items():
        if address.task == task:
            by_label.setdefault(address.label, {})[address.case, address.fold] = pair
    return {label: _folds(metric, pairs) for label, pairs in by_label.items()}


def _folds(metric: str, pairs: Mapping[Fold, Pair]) -> pd.DataFrame:
    values = np.array([[_value(record, metric) for record in pair] for pair in pairs.values()])
    answered = np.array(
        [[_has_result(record, metric) for record in pair] for pair in pairs.values()]
    )
    finite, undefined = np.isfinite(values), answered & np.isnan(values)
    never = answered.any(axis=0) & (undefined == answered).all(axis=0)
    kept = (finite.any(axis=1) | ~undefined.any(axis=1)) & ~never.any()
    index = pd.MultiIndex.from_tuples(list(pairs), names=["case", "fold"])
    values[~finite] = np.nan
    return pd.DataFrame(values[kept], index[kept], columns=["first", "second"])


def _has_result(record: Record, metric: str) -> bool:
    """Return whether there is a result; all scores of a model that diverged are not finite."""
    finite = not record.scores or any(map(math.isfinite, record.scores.values()))
    return (record.status is Status.OK or metric in record.scores) and finite


def _value(record: Record, metric: str) -> float:
    return record.scores.get(metric, math.nan)
