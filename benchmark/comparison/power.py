"""Which difference so many people show, from the spread between people that a run measured.

The *spread* is the standard deviation over units of the paired difference of two entrants' losses,
by the units and the test of the report (`mocapbench.reports.analysis.units`). For units of unequal
shares it is the one of as many of equal shares as they are worth, so that the test of the run and
the plan agree.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.benchmark.comparison.rows import POOLED
from mocapbench.benchmark.errors import UnknownNameError, UsageError
from mocapbench.metrics.statistics import (
    FEWEST_UNITS,
    detectable_difference,
    deviation_interval,
    too_few,
    unit_means,
    units_needed,
)
from mocapbench.reports import Bundle, CaseLayout
from mocapbench.reports.analysis.cells import Cells, cells
from mocapbench.reports.analysis.results import TaskResults, task_results
from mocapbench.reports.analysis.standings import (
    Place,
    next_best,
    standings,
    too_few_units,
)

__all__ = ["SHOWN_BY", "list_spreads", "plan_people", "read_numbers", "require_plan"]

SHOWN_BY = "shown_by_"
"""What columns begin with that say which difference a number of units shows."""

NO_SPREAD = "the same difference in all"
_ADVICE = {
    NO_SPREAD: "choose other models with --models",
    Place.INCOMPLETE.value: (
        "one has scores that the other lacks; `mocapbench status` tells which jobs failed, and "
        "--models chooses other models"
    ),
}
"""What to do where nothing can be planned; anywhere else there are too few people."""
_MORE = "run more of them (`mocapbench run --folds`), or add recordings of more people"

_ROUNDING = 1e-12
"""Spreads below this share of the greatest difference are rounding."""

Spread = Mapping[str, Any]
"""One row: where, of which entrants, and what was measured; NaN where nothing can be planned."""


def list_spreads(
    bundle: Bundle,
    *,
    tasks: Sequence[str] = (),
    metric: str | None = None,
    models: Sequence[str] | None = None,
) -> pd.DataFrame:
    """Return the spread of a difference for each case of a run, and for all cases of a task.

    Parameters
    ----------
    bundle : Bundle
    tasks : sequence of str
        By default all of the run.
    metric : str or None
        By default the one by which a task is scored.
    models : sequence of str or None
        Two labels; by default, in each row, the best and the next that differs from it.

    Returns
    -------
    DataFrame
        Columns ``task``, ``metric``, ``case``, ``first``, ``second``, ``unit``, ``n``, what the
        units are ``worth``, the ``difference``, its ``spread`` with the 95 % interval
        ``spread_low`` to ``spread_high``, and why there is none: the ``finding``.

    Raises
    ------
    UnknownNameError
        If the run has no such task, or no score of such a model or metric.
    UsageError
        If ``models`` are not two, or there is no spread in any row.
    """
    if models is not None and len(set(models)) != 2:
        raise UsageError(
            f"power: expected two models to compare, got {', '.join(models) or 'neither'}"
        )
    layouts = {layout.name: layout for layout in bundle.layouts}
    _require_known("task of the run", tasks, layouts)
    results = [task_results(bundle, layouts[name]) for name in tasks or layouts]
    _require_known("ranked model of these tasks", models or (), _list_ranked(results))
    scored = {name for each in results for name in each.folds.index.unique("metric")}
    _require_known("metric of these tasks", [metric] if metric else [], scored)
    rows = [row for each in results for row in _list_rows(each, metric, models)]
    if not any(math.isfinite(row["spread"]) for row in rows):
        raise UsageError(_explain_lack(rows))
    return pd.DataFrame(rows)


def read_numbers(texts: Sequence[str]) -> list[int]:
    """Return numbers of people, each once.

    Raises
    ------
    UsageError
        If one is no whole number, or fewer than are tested.
    """
    wrong = [text for text in texts if not text.isdecimal() or int(text) < FEWEST_UNITS]
    if wrong or not texts:
        raise UsageError(
            f"power: expected numbers of people from {FEWEST_UNITS}, as fewer are not tested, got "
            f"--people {','.join(texts)}"
        )
    return list(dict.fromkeys(map(int, texts)))


def require_plan(difference: float | None, alpha: float, power: float) -> None:
    """Refuse what `plan_people` cannot plan.

    Raises
    ------
    UsageError
        If the difference is not above 0, or not 0 < alpha < power < 1.
    """
    if difference is not None and not 0.0 < difference < math.inf:
        raise UsageError(f"power: expected a difference above 0, got --difference {difference:g}")
    if not 0.0 < alpha < power < 1.0:
        raise UsageError(
            "power: expected a level and a greater power, both between 0 and 1, got "
            f"--alpha {alpha:g} and --power {power:g}"
        )


def plan_people(
    spreads: pd.DataFrame,
    people: Sequence[int],
    difference: float | None,
    alpha: float,
    power: float,
) -> pd.DataFrame:
    """Return spreads with the differences that people show, and the people that one needs.

    Parameters
    ----------
    spreads : DataFrame
        From `list_spreads`.
    people : sequence of int
        Numbers of units.
    difference : float or None
        The difference to show; by default the one that was measured.
    alpha, power : float
        The level of the test, and the probability to find the difference.

    Returns
    -------
    DataFrame
        With columns ``shown_now``, the difference that the run's own units show, and ``shown_by_N``
        of each number; ``claim``, the difference to show, and the units ``needed`` for it.
    """
    planned = spreads.assign(
        shown_now=_list_shown(spreads["worth"], spreads["spread"], alpha, power),
        claim=spreads["difference"] if difference is None else difference,
    )
    for n in people:
        numbers = np.full(len(spreads), n)
        planned[f"{SHOWN_BY}{n}"] = _list_shown(numbers, spreads["spread"], alpha, power)
    planned["needed"] = [
        units_needed(claim, spread, alpha, power) if spread > 0.0 else math.nan
        for claim, spread in zip(planned["claim"], planned["spread"], strict=True)
    ]
    return planned


def _require_known(kind: str, names: Sequence[str], known: Collection[str]) -> None:
    for name in names:
        if name not in known:
            raise UnknownNameError(kind, name, sorted(known))


def _list_ranked(results: Sequence[TaskResults]) -> set[str]:
    return {label for each in results for label in each.layout.ranked}


def _list_rows(
    results: TaskResults, metric: str | None, models: Sequence[str] | None
) -> list[Spread]:
    """Return the rows of a task: its cases, and all of those that count if they are several."""
    name = metric or results.layout.page.metrics[0]
    pooled = results.representative_cases(name)
    groups = [(case.name, [case]) for case in results.cases]
    groups += [(POOLED, pooled)] if len(pooled) > 1 else []
    found = (_measure_spread(results, name, cases, models) for _, cases in groups)
    about = {"task": results.layout.name, "metric": name}
    return [
        {**about, "case": case, **row} for (case, _), row in zip(groups, found, strict=True) if row
    ]


def _measure_spread(
    results: TaskResults, metric: str, cases: Sequence[CaseLayout], models: Sequence[str] | None
) -> Spread:
    """Return what a row has besides its place; nothing where two entrants have no score."""
    scored = cells(results, metric, cases)
    pair = _choose_pair(results, metric, cases) if models is None else models
    if len(pair) < 2 or not set(pair) <= set(scored.labels):
        return {}
    either = scored.scored[[scored.labels.index(label) for label in pair]]
    both = np.asarray(either.all(axis=0))
    if not both.any():
        return {}
    lost = bool((either.any(axis=0) != both).any())
    return {"first": pair[0], "second": pair[1], **_describe_difference(scored, pair, both, lost)}


def _choose_pair(results: TaskResults, metric: str, cases: Sequence[CaseLayout]) -> list[str]:
    """Return the best entrant and the next that differs from it, as the report has them."""
    found = standings(results, metric, cases)
    second = next_best(found) if found else None
    return [found[0].label, second.label] if second else []


def _describe_difference(
    scored: Cells, pair: Sequence[str], both: NDArray[np.bool_], lost: bool
) -> Spread:
    """Return the units, the mean difference and its spread, or in the ``finding`` why not."""
    shares: Array = scored.weights(both).sum(axis=1)
    first, second = (
        scored.by_unit(scored.losses, both)[scored.labels.index(label)] for label in pair
    )
    means = unit_means(second - first, shares)
    worth, spread = float(means.freedom) + 1.0, float(means.error) * math.sqrt(means.freedom + 1.0)
    finding = _find_obstacle(scored.unit, second - first, worth, spread, lost)
    spread = math.nan if finding else spread
    low, high = deviation_interval(spread, worth - 1.0)
    return {
        "unit": scored.unit,
        "n": shares.size,
        "worth": worth,
        "difference": float(means.mean),
        "spread": spread,
        "spread_low": low,
        "spread_high": high,
        "finding": finding,
    }


def _find_obstacle(unit: str, differences: Array, worth: float, spread: float, lost: bool) -> str:
    """Return why nothing can be planned from a difference; empty where it can."""
    if lost:
        return Place.INCOMPLETE.value
    if too_few(worth - 1.0):
        return too_few_units(differences.size, unit)
    return "" if spread > _ROUNDING * np.abs(differences).max() else NO_SPREAD


def _explain_lack(rows: Sequence[Spread]) -> str:
    """Return why there is no spread in any row, and what to do."""
    if not rows:
        return (
            "power: expected two models with different scores in each fold of some case, got none "
            "in this run; choose two with --models, or another metric with --metric"
        )
    found = dict.fromkeys(str(row["finding"]) for row in rows)
    return (
        f"power: expected scores of two models for {FEWEST_UNITS} or more people or folds, whose "
        f"difference varies, got: {', '.join(found)}; "
        + "; ".join(dict.fromkeys(_ADVICE.get(each, _MORE) for each in found))
    )


def _list_shown(
    numbers: Iterable[float], spreads: Iterable[float], alpha: float, power: float
) -> list[float]:
    return [
        detectable_difference(n, spread, alpha, power) if spread > 0.0 else math.nan
        for n, spread in zip(numbers, spreads, strict=True)
    ]
