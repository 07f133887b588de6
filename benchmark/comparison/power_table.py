"""A plan of people for the terminal."""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterator, Mapping
from typing import Any

import pandas as pd
from rich.box import SIMPLE
from rich.table import Table

from mocapbench.benchmark.comparison.power import SHOWN_BY
from mocapbench.benchmark.comparison.printing import describe_metric, format_value
from mocapbench.metrics.statistics import MOST_UNITS

__all__ = ["power_notes", "power_tables"]


def power_tables(planned: pd.DataFrame, difference: float | None) -> Iterator[Table]:
    """Yield one table per task and metric, for a console that knows no markup.

    Parameters
    ----------
    planned : DataFrame
        From `mocapbench.benchmark.comparison.power.plan_people`.
    difference : float or None
        The one that was asked for.
    """
    numbers = [
        str(name).removeprefix(SHOWN_BY) for name in planned if str(name).startswith(SHOWN_BY)
    ]
    claim = "this" if difference is None else format(difference, "g")
    head = ["case", "n", "models", "by", "spread", "n show"]
    for (task, metric), rows in planned.groupby(["task", "metric"], sort=False):
        title = f"{task}: {describe_metric(str(metric))}"
        table = Table(box=SIMPLE, padding=0, title=title, title_justify="left")
        for name in (*head, *(f"{n} show" for n in numbers), f"n for {claim}"):
            table.add_column(name, overflow="fold")
        for row in rows.to_dict("records"):
            table.add_row(*_list_cells(row, numbers))
        yield table


def power_notes(alpha: float, power: float) -> list[str]:
    """Return what has to be known to read the tables."""
    return [
        "“By” is how much better the first model is than the second. The spread is the standard "
        "deviation of that difference over people, or else over independent folds or cases, as the "
        "report counts them, with its 95 % interval. The n that is needed grows with its square.",
        f"“n show” is the difference that a two-sided paired t-test at {alpha:g} finds with the "
        f"probability {power:g}. Holm’s method corrects m tests: of the least favourable one the "
        f"level is {alpha:g}/m (--alpha).",
    ]


def _list_cells(row: Mapping[Hashable, Any], numbers: list[str]) -> list[str]:
    shown = [row["shown_now"], *(row[f"{SHOWN_BY}{n}"] for n in numbers)]
    return [
        row["case"],
        str(row["n"]),
        f"{row['first']}, {row['second']}",
        format_value(row["difference"]),
        row["finding"] or _describe_spread(row),
        *map(format_value, shown),
        _format_needed(row["needed"]),
    ]


def _describe_spread(row: Mapping[Hashable, Any]) -> str:
    spread, low, high = (
        format_value(row[name]) for name in ("spread", "spread_low", "spread_high")
    )
    return f"{spread} [{low}, {high}]"


def _format_needed(needed: float) -> str:
    if math.isnan(needed):
        return "–"
    return f"{needed:.0f}" if math.isfinite(needed) else f"over {MOST_UNITS}"
