"""Sentences on the test behind a shared rank: its units, and the rows where none is possible."""

from __future__ import annotations

from mocapbench.metrics.statistics import SharedRank
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.text import counted

__all__ = ["lead_note", "rank_notes", "untested_reason"]

FOLD = "one fold"
WINDOWS = "overlapping windows of one recording count as one unit"


def rank_notes(results: TaskResults, metric: str) -> tuple[str, ...]:
    """Return the notes under a table whose first ranks are in bold."""
    ranks = _ranks(results, metric)
    sizes = sorted({rank.n for rank in ranks if rank.tested})
    tested = (
        "Bold: the best mean of a row, and every mean that the paired t-test with Holm’s "
        f"correction does not separate from it (5 %, {_fold_counts(sizes)})."
    )
    untested = f"No test: {untested_reason(results)}. Only the best mean of such a row is in bold."
    return (
        *([tested] if sizes else []),
        *([untested] if not all(rank.tested for rank in ranks) else []),
    )


def _ranks(results: TaskResults, metric: str) -> list[SharedRank]:
    ranks = (results.first_rank(case.name, metric) for case in results.cases)
    return [rank for rank in ranks if rank is not None]


def _fold_counts(sizes: list[int]) -> str:
    *fewer, most = [str(size) for size in sizes] or ["0"]
    return f"n = {' or '.join([*fewer, most])} folds"


def untested_reason(results: TaskResults) -> str:
    """Return why a row with a single unit cannot be tested."""
    return FOLD if results.layout.independent_folds else WINDOWS


def lead_note(results: TaskResults, metric: str, label: str, cases: list[str]) -> str:
    """Return in how many of ``cases``, which ``label`` leads, the lead is more than chance."""
    ranks = [rank for case in cases if (rank := results.first_rank(case, metric)) is not None]
    tested = [rank for rank in ranks if rank.tested]
    if not tested:
        return f"Not tested: {untested_reason(results)}."
    alone = [rank for rank in tested if rank.labels == (label,)]
    others = dict.fromkeys(other for rank in tested for other in rank.labels if other != label)
    shared = f"the test does not separate it from {', '.join(others)}"
    if not alone:
        return f"Case by case the lead may be chance: {shared}."
    if not others:
        return "The lead is more than chance."
    return f"More than chance in {counted(len(alone), 'case')}; elsewhere {shared}."
