"""The best of some entrants over the same cases, such as what a winner is to be compared with."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout

__all__ = ["best_over_cases"]


def best_over_cases(
    results: TaskResults,
    metric: str,
    cases: Sequence[CaseLayout],
    labels: Iterable[str],
    beside: str,
) -> str | None:
    """Return the label of ``labels`` with the best mean over ``cases``.

    Parameters
    ----------
    results : TaskResults
    metric : str
    cases : sequence of CaseLayout
        Cases in which ``beside`` has a score.
    labels : iterable of str
    beside : str
        The label that it stands beside. One that has fewer folds in some case takes no part: they
        may be the easy ones.

    Returns
    -------
    str or None
        None where none takes part.
    """
    needed = [results.estimates[case.name, beside, metric].n for case in cases]
    losses = {
        label: _mean_loss(results, metric, cases, label)
        for label in labels
        if all(
            (mean := results.estimate(case.name, label, metric)) is not None and mean.n >= n
            for case, n in zip(cases, needed, strict=True)
        )
    }
    return min(losses, key=losses.__getitem__, default=None)


def _mean_loss(results: TaskResults, metric: str, cases: Sequence[CaseLayout], label: str) -> float:
    loss = results.metrics[metric].loss
    means = [results.estimates[case.name, label, metric].mean for case in cases]
    return float(np.mean([loss(mean) for mean in means]))
