"""The values of a metric by case and label, one a fold."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping

from mocapbench.reports.analysis.results import TaskResults

__all__ = ["FoldValues", "fold_values"]

FoldValues = Mapping[tuple[str, str], list[float]]


def fold_values(results: TaskResults, metric: str) -> FoldValues:
    """Return the finite values of ``metric`` by (case, label), in the order of folds."""
    chosen = results.scores[results.scores["metric"] == metric]
    values = defaultdict(list)
    columns = (chosen[name].to_list() for name in ("case", "label", "value"))
    for case, label, value in zip(*columns, strict=True):
        values[case, label].append(value)
    return values
