"""Models that the paper lacks and whose mean is better than that of one of the paper's models."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from mocapbench.reports.analysis.contrasts import (
    CorrectedContrast,
    corrected_contrasts,
    pooled_contrast,
)
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout

__all__ = ["Win", "mean_over_cases", "wins"]


@dataclass(frozen=True)
class Win:
    """The cases where the mean of one entrant is better than that of another.

    Parameters
    ----------
    winner, loser : str
        Labels; the paper has a counterpart of the loser and none of the winner.
    cases : tuple of CaseLayout
        Where the winner's mean is better.
    shared : int
        In how many cases both have a score.
    means : tuple of two float
        The winner's and the loser's mean over ``cases``.
    overall : CorrectedContrast
        Their contrast over all shared cases, corrected over every pair that could have been a win.
    """

    winner: str
    loser: str
    cases: tuple[CaseLayout, ...]
    shared: int
    means: tuple[float, float]
    overall: CorrectedContrast


def wins(results: TaskResults, metric: str) -> list[Win]:
    """Return the wins of labels without a published counterpart over labels with one.

    Returns
    -------
    list of Win
        By loser in table order, and for each loser by the number of cases won, most first.
    """
    published = results.layout.page.published_models
    losers = [label for label in results.layout.ranked if label in published]
    winners = [label for label in results.layout.ranked if label not in published]
    pairs = [
        (winner, loser)
        for loser, winner in product(losers, winners)
        if _shared_cases(results, metric, winner, loser)
    ]
    contrasts = corrected_contrasts([pooled_contrast(results, metric, *pair) for pair in pairs])
    all_wins = [
        _win(results, metric, *pair, contrast)
        for pair, contrast in zip(pairs, contrasts, strict=True)
        if _cases_won(results, metric, *pair)
    ]
    return sorted(all_wins, key=lambda win: (losers.index(win.loser), -len(win.cases)))


def mean_over_cases(
    results: TaskResults, metric: str, cases: Sequence[CaseLayout], labels: Sequence[str]
) -> float:
    """Return the mean of the means of ``labels``, one label for each of ``cases``."""
    pairs = zip(cases, labels, strict=True)
    return float(
        np.mean([results.estimates[case.name, label, metric].mean for case, label in pairs])
    )


def _win(
    results: TaskResults, metric: str, winner: str, loser: str, overall: CorrectedContrast
) -> Win:
    won = _cases_won(results, metric, winner, loser)
    n_shared = len(_shared_cases(results, metric, winner, loser))
    one, other = (
        mean_over_cases(results, metric, won, [label] * len(won)) for label in (winner, loser)
    )
    return Win(winner, loser, tuple(won), n_shared, (one, other), overall)


def _cases_won(results: TaskResults, metric: str, winner: str, loser: str) -> list[CaseLayout]:
    shared = _shared_cases(results, metric, winner, loser)
    return [case for case in shared if _is_better(results, metric, case.name, winner, loser)]


def _shared_cases(results: TaskResults, metric: str, *labels: str) -> list[CaseLayout]:
    cases = results.representative_cases(metric)
    return [case for case in cases if set(labels) <= set(results.ranking(case.name, metric))]


def _is_better(results: TaskResults, metric: str, case: str, winner: str, loser: str) -> bool:
    loss = results.metrics[metric].loss
    one, other = (results.estimates[case, label, metric].mean for label in (winner, loser))
    return loss(one) < loss(other)
