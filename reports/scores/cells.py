"""The cells of a table of scores: means of cases, and jobs that gave no score."""

from __future__ import annotations

from mocapbench.basics.words import counted
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.troubles import DATA_MISSING, Trouble
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.scores.table import NO_SCORE, ScoreCell
from mocapbench.reports.text import cell_anchor, number

__all__ = ["score_cell"]


def score_cell(
    results: TaskResults, case: CaseLayout, label: str, metric: str, places: int, *, best: bool
) -> ScoreCell:
    """Return the mean over folds, bold where it is the ``best``, or why there is none."""
    estimate = results.estimate(case.name, label, metric)
    troubles = results.lost(case.name, label, metric)
    link = cell_anchor(results.layout.name, case.name, label)
    if estimate is None:
        reasons = _reasons(troubles)
        return ScoreCell(reasons, kind="trouble", link=link) if reasons else NO_SCORE
    lost = f"{counted(len(troubles), 'fold')} lost" if troubles else ""
    text, kind = number(estimate.mean, places), "best" if best else ""
    return ScoreCell(text, estimate.mean, kind, lost, link)


def _reasons(troubles: tuple[Trouble, ...]) -> str:
    """Return why there is no score, nothing where the recording is missing: the head says so."""
    reasons = dict.fromkeys(trouble.status for trouble in troubles)
    return ", ".join(reason.replace("-", " ") for reason in reasons if reason != DATA_MISSING)
