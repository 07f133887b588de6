"""The cells of a table of scores: means of cases, and jobs that gave no score."""

from __future__ import annotations

from collections import Counter
from urllib.parse import quote

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.troubles import DATA_MISSING, Trouble
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.scores.table import NO_SCORE, ScoreCell
from mocapbench.reports.text import counted, number

__all__ = ["cell_address", "score_cell"]


def cell_address(task: str, case: str, label: str) -> str:
    """Return the address on the page of what is behind the score of ``label`` in ``case``."""
    return "cell=" + "/".join(quote(name, safe="") for name in (task, case, label))


def score_cell(
    results: TaskResults, case: CaseLayout, label: str, metric: str, places: int, *, best: bool
) -> ScoreCell:
    """Return the mean over folds, bold where it is the ``best``, or why there is none."""
    estimate = results.estimate(case.name, label, metric)
    troubles = results.troubles.get((case.name, label), ())
    link = cell_address(results.layout.name, case.name, label)
    if estimate is None:
        return ScoreCell(_reasons(troubles), kind="trouble", link=link) if troubles else NO_SCORE
    lost = f"{counted(len(troubles), 'fold')} lost" if troubles else ""
    text, kind = number(estimate.mean, places), "best" if best else ""
    return ScoreCell(text, estimate.mean, kind, lost, link)


def _reasons(troubles: tuple[Trouble, ...]) -> str:
    reasons = Counter(trouble.status for trouble in troubles)
    return ", ".join("no data" if r == DATA_MISSING else r.replace("-", " ") for r in reasons)
