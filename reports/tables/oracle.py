"""The table of errors as multiples of the oracle's."""

from __future__ import annotations

import numpy as np

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.tables.base import Cell, Table, headings
from mocapbench.reports.text import number, slug

__all__ = ["oracle_table"]

METRIC = "smse_pooled"


def oracle_table(results: TaskResults) -> Table | None:
    """Return each label's error as a multiple of the oracle's; None where there is no oracle.

    The ratio is the mean over cases of (fold mean of pooled SMSE) / (oracle's fold mean), over the
    cases where both have a score.
    """
    oracle = results.layout.oracle
    ratios = {label: _ratios(results, label, oracle) for label in results.layout.ranked}
    means = {label: float(np.mean(values)) for label, values in ratios.items() if values}
    if not means:
        return None
    order = sorted(means, key=means.__getitem__)
    rows = [(label, means[label], len(ratios[label])) for label in order]
    return Table(
        id=slug(results.layout.name, "oracle"),
        caption="Ratio to the oracle, pooled SMSE",
        columns=headings(["entrant", "ratio", "cases"]),
        rows=tuple(
            (Cell(label), Cell(f"{number(ratio, 2)}×"), Cell(str(n))) for label, ratio, n in rows
        ),
    )


def _ratios(results: TaskResults, label: str, oracle: str) -> list[float]:
    pairs = [
        [results.estimate(case.name, name, METRIC) for name in (label, oracle)]
        for case in results.cases
    ]
    return [ours.mean / limit.mean for ours, limit in pairs if ours and limit and limit.mean > 0.0]
