"""The values of a metric by case and label, one a fold."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.units import FoldSample, unit_names

__all__ = ["FoldValues", "fold_values"]

FoldValues = Mapping[tuple[str, str], FoldSample]


def fold_values(results: TaskResults, metric: str) -> FoldValues:
    """Return the finite values of ``metric`` by (case, label), in the order of folds."""
    chosen = results.scores[results.scores["metric"] == metric]
    values: dict[tuple[str, str], dict[int, float]] = defaultdict(dict)
    columns = (chosen[name].to_list() for name in ("case", "label", "fold", "value"))
    for case, label, fold, value in zip(*columns, strict=True):
        values[case, label][fold] = value
    layouts = {case.name: case for case in results.layout.cases}
    independent = results.layout.independent_folds
    return {
        (case, label): FoldSample.of(
            [*folds.values()],
            unit_names(layouts[case], [*folds], independent=independent),
            [case] * len(folds),
        )
        for (case, label), folds in values.items()
    }
