"""What the means of a table rest on: how many cases, folds and outputs."""

from __future__ import annotations

from collections.abc import Sequence

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout

__all__ = ["basis"]


def basis(results: TaskResults, metric: str, cases: Sequence[CaseLayout]) -> str:
    """Return in few words what the means of ``metric`` over ``cases`` are over."""
    names = {case.name for case in cases}
    rows = results.scores[results.scores["metric"] == metric]
    sizes = {
        estimate.n
        for (case, _, name), estimate in results.estimates.items()
        if name == metric and case in names
    }
    *fewer, most = sorted(sizes) or [0]
    folds = " or ".join([*map(str, fewer), format_count(most, "fold")])
    left_out = int(max(rows["left_out"], default=0))
    lost = f", up to {format_count(left_out, 'output')} left out as degenerate" if left_out else ""
    each = " each" if len(cases) > 1 else ""
    return f"{format_count(len(cases), 'case')}, {folds}{each}{lost}"
