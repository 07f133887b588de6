"""The cells of a table of scores: means of cases, and jobs that gave no score."""

from __future__ import annotations

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.failures import DATA_MISSING, Failure
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.scores.table import NO_SCORE, ScoreCell
from mocapbench.reports.text import cell_anchor, number

__all__ = ["score_cell"]


def score_cell(
    results: TaskResults, case: CaseLayout, label: str, metric: str, places: int, *, best: bool
) -> ScoreCell:
    """Return the mean over folds, bold where it is the ``best``, or why there is none."""
    estimate = results.estimate(case.name, label, metric)
    failures = results.find_failures(case.name, label, metric)
    link = cell_anchor(results.layout.name, case.name, label)
    if estimate is None:
        reasons = _reasons(failures)
        return ScoreCell(reasons, kind="failure", link=link) if reasons else NO_SCORE
    lost = f"{format_count(len(failures), 'fold')} lost" if failures else ""
    text, kind = number(estimate.mean, places), "best" if best else ""
    return ScoreCell(text, estimate.mean, kind, lost, link)


def _reasons(failures: tuple[Failure, ...]) -> str:
    """Return why there is no score, nothing where the recording is missing: the head says so."""
    reasons = dict.fromkeys(failure.status for failure in failures)
    return ", ".join(reason.replace("-", " ") for reason in reasons if reason != DATA_MISSING)
