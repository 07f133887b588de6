"""The means of a model over the folds of each case that counts."""

from __future__ import annotations

from mocapbench.reports.analysis.results import TaskResults

__all__ = ["case_means"]


def case_means(results: TaskResults, metric: str, label: str) -> list[float]:
    """Return the mean of each case that counts over cases, of those where a label has a score."""
    cases = results.representative_cases(metric)
    found = [results.estimate(case.name, label, metric) for case in cases]
    return [estimate.mean for estimate in found if estimate is not None]
