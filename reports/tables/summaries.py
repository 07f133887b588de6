"""Tables over all cases of a task: ratio to the oracle, calibration and cost."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence

import numpy as np
import pandas as pd

from mocapbench.metrics.base import Direction
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.tables.base import ABSENT, Cell, Table, counted, headings, number, slug

__all__ = ["calibration_table", "cost_table", "oracle_table"]

ORACLE_METRIC = "smse_pooled"
SHORTEST = 0.001
_MEASURED = ("entrant", "jobs", "fit, median s", "predict, median s", "peak memory, MB")
_OPTIONAL = ("iterations, median", "converged", "engine")


def oracle_table(results: TaskResults) -> Table | None:
    """Return each label's error as a multiple of the oracle's; None where there is no oracle.

    The mean over cases of (fold mean of pooled SMSE) / (oracle's fold mean), over the cases where
    both have a score.
    """
    oracle = results.layout.oracle
    ratios = {label: _ratios(results, label, oracle) for label in results.layout.ranked}
    means = {label: float(np.mean(values)) for label, values in ratios.items() if values}
    if not means:
        return None
    order = sorted(means, key=means.__getitem__)
    return Table(
        id=slug(results.layout.name, "oracle"),
        caption="Ratio to the oracle: pooled SMSE over that of the generating process itself",
        columns=headings(["entrant", "ratio", "cases"]),
        rows=tuple(
            (Cell(label), Cell(f"{number(means[label], 2)}×"), Cell(str(len(ratios[label]))))
            for label in order
        ),
        data=pd.DataFrame(
            [{"label": at, "ratio": means[at], "cases": len(ratios[at])} for at in order]
        ),
        notes=("Mean over cases. 1.00× is the limit: nothing is left to learn.",),
    )


def _ratios(results: TaskResults, label: str, oracle: str) -> list[float]:
    pairs = [
        [results.estimate(case.name, each, ORACLE_METRIC) for each in (label, oracle)]
        for case in results.cases
    ]
    return [own.mean / limit.mean for own, limit in pairs if own and limit and limit.mean > 0.0]


def calibration_table(results: TaskResults) -> Table | None:
    """Return every metric that has a target, beside it; None where there is none.

    Coverage of central intervals is such a metric. Means run over folds and then over cases.
    Metrics with a table of their own are left out.
    """
    metrics = [name for name in _targets(results) if name not in results.layout.metrics]
    values = {
        (label, metric): _mean_over_cases(results, label, metric)
        for label in results.layout.labels
        for metric in metrics
    }
    labels = [
        label
        for label in results.layout.labels
        if any(values[label, metric] is not None for metric in metrics)
    ]
    if not labels:
        return None
    return Table(
        id=slug(results.layout.name, "calibration"),
        caption="Calibration: mean over cases and folds, beside the nominal value",
        columns=headings(["entrant", *(results.metrics[metric].title for metric in metrics)]),
        rows=(
            (Cell("nominal"), *(_nominal(results, metric) for metric in metrics)),
            *(
                (Cell(label), *(_fraction(values[label, metric]) for metric in metrics))
                for label in labels
            ),
        ),
        data=pd.DataFrame(
            [{"label": label, **{m: values[label, m] for m in metrics}} for label in labels]
        ),
        notes=("Below nominal: too sure of itself. Above: too cautious.",),
    )


def _targets(results: TaskResults) -> Sequence[str]:
    scored = set(results.scores["metric"])
    return [
        name
        for name, info in results.metrics.items()
        if info.direction is Direction.TARGET and name in scored
    ]


def _mean_over_cases(results: TaskResults, label: str, metric: str) -> float | None:
    found = [results.estimate(case.name, label, metric) for case in results.cases]
    means = [estimate.mean for estimate in found if estimate is not None]
    return float(np.mean(means)) if means else None


def _nominal(results: TaskResults, metric: str) -> Cell:
    return Cell(number(results.metrics[metric].target or 0.0, 2), kind="published")


def _fraction(value: float | None) -> Cell:
    return ABSENT if value is None else Cell(number(value, 2))


def cost_table(results: TaskResults) -> Table | None:
    """Return median seconds, peak memory and convergence per label, over the jobs that finished.

    Iterations, convergence and engine get a column where at least one label has them.
    """
    done = results.records[results.records["status"] == "ok"]
    if done.empty:
        return None
    data = pd.DataFrame(
        [
            _cost(label, done[done["label"] == label])
            for label in results.layout.labels
            if label in set(done["label"])
        ]
    )
    columns = zip(*(_cost_row(row) for row in data.to_dict("records")), strict=True)
    told = {
        title: cells
        for title, cells in zip(_MEASURED + _OPTIONAL, columns, strict=True)
        if title in _MEASURED or any(cell != ABSENT for cell in cells)
    }
    return Table(
        id=slug(results.layout.name, "cost"),
        caption="Cost: over the jobs that finished",
        columns=headings(list(told)),
        rows=tuple(zip(*told.values(), strict=True)),
        data=data,
    )


def _cost(label: str, jobs: pd.DataFrame) -> dict[str, object]:
    converged = jobs["converged"].dropna()
    return {
        "label": label,
        "jobs": len(jobs),
        "fit_seconds": jobs["fit_seconds"].dropna().astype(float).median(),
        "predict_seconds": jobs["predict_seconds"].dropna().astype(float).median(),
        "peak_memory_mb": jobs["peak_memory_mb"].astype(float).max(),
        "iterations": jobs["iterations"].dropna().astype(float).median(),
        "converged": float(converged.astype(float).mean()) if len(converged) else np.nan,
        "engine": "; ".join(dict.fromkeys(filter(None, jobs["engine"]))),
    }


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
    """Return the first engine by name with the reason for it, and how many others there were."""
    first, *others = engine.split("; ")
    name, _, reason = first.partition(": ")
    more = f" and {counted(len(others), 'other')} by case" if others else ""
    return Cell(f"{name}{more}", note=reason) if name else ABSENT


def _seconds(value: float) -> Cell:
    """Return three digits, never as a power of ten, and no more than a millisecond can tell."""
    if value < SHORTEST:
        return Cell(f"< {SHORTEST}")
    digits = np.format_float_positional(value, precision=3, fractional=False, trim="-")
    return ABSENT if np.isnan(value) else Cell(digits)


def _measure(value: float, layout: str) -> Cell:
    return ABSENT if np.isnan(value) else Cell(layout.format(value))
