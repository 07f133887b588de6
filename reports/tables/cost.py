"""The table of cost: seconds, memory, iterations, convergence and engine."""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping
from statistics import fmean, median
from typing import Any

import numpy as np
import pandas as pd

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.tables.base import ABSENT, Cell, Table, headings
from mocapbench.reports.text import slug

__all__ = ["cost_table"]

SHORTEST = 0.001
_MEASURED = ("entrant", "jobs", "fit, median s", "predict, median s", "peak memory, MB")
_OPTIONAL = ("iterations, median", "converged", "engine")


def cost_table(results: TaskResults) -> Table | None:
    """Return median seconds, peak memory and convergence per label, over the jobs that finished.

    Iterations, convergence and engine get a column where at least one label has them.
    """
    done = results.records[results.records["status"] == "ok"]
    if done.empty:
        return None
    by_label = dict(iter(done.astype(object).groupby("label", sort=False)))
    data = pd.DataFrame(
        [_cost(label, by_label[label]) for label in results.layout.labels if label in by_label]
    )
    shown = _columns(data)
    return Table(
        id=slug(results.layout.name, "cost"),
        caption="Cost: over the jobs that finished",
        columns=headings(list(shown)),
        rows=tuple(zip(*shown.values(), strict=True)),
    )


def _columns(data: pd.DataFrame) -> dict[str, tuple[Cell, ...]]:
    """Return the columns by title, without optional ones that no label has a value in."""
    columns = zip(*(_cost_row(row) for row in data.to_dict("records")), strict=True)
    return {
        title: cells
        for title, cells in zip(_MEASURED + _OPTIONAL, columns, strict=True)
        if title in _MEASURED or any(cell != ABSENT for cell in cells)
    }


def _cost(label: str, jobs: pd.DataFrame) -> dict[str, object]:
    converged = _keep_finite(jobs["converged"])
    return {
        "label": label,
        "jobs": len(jobs),
        "fit_seconds": _median(jobs["fit_seconds"]),
        "predict_seconds": _median(jobs["predict_seconds"]),
        "peak_memory_mb": max(_keep_finite(jobs["peak_memory_mb"]), default=math.nan),
        "iterations": _median(jobs["iterations"]),
        "converged": fmean(converged) if converged else math.nan,
        "engine": "; ".join(dict.fromkeys(filter(None, jobs["engine"]))),
    }


def _median(values: pd.Series[Any]) -> float:
    """Return the median of what is known, NaN where nothing is."""
    known = _keep_finite(values)
    return median(known) if known else math.nan


def _keep_finite(values: pd.Series[Any]) -> list[float]:
    numbers = (math.nan if value is None else float(value) for value in values.tolist())
    return [number for number in numbers if math.isfinite(number)]


def _cost_row(row: Mapping[Hashable, float]) -> tuple[Cell, ...]:
    return (
        Cell(str(row["label"])),
        Cell(str(row["jobs"])),
        _seconds(row["fit_seconds"]),
        _seconds(row["predict_seconds"]),
        _measure(row["peak_memory_mb"], "{:.0f}"),
        _measure(row["iterations"], "{:.0f}"),
        _measure(row["converged"], "{:.0%}"),
        _engine(str(row["engine"])),
    )


def _engine(engine: str) -> Cell:
    """Return the names of the engines, without the reasons for their choice."""
    names = dict.fromkeys(each.partition(":")[0] for each in engine.split("; "))
    return Cell(", ".join(names)) if engine else ABSENT


def _seconds(value: float) -> Cell:
    """Return three digits, never as a power of ten, and nothing finer than a millisecond."""
    if value < SHORTEST:
        return Cell(f"< {SHORTEST}")
    digits = np.format_float_positional(value, precision=3, fractional=False, trim="-")
    return ABSENT if np.isnan(value) else Cell(digits)


def _measure(value: float, layout: str) -> Cell:
    return ABSENT if np.isnan(value) else Cell(layout.format(value))
