"""Models that the paper lacks and whose mean is better than that of one of the paper's models."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product

from mocapbench.reports.analysis.cells import cells
from mocapbench.reports.analysis.contrasts import PairContrast, contrasts
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import Place, too_few_units

__all__ = ["wins"]


def wins(results: TaskResults, metric: str) -> Mapping[str, tuple[str, str]]:
    """Return the best label without a published counterpart for each label that has one.

    Returns
    -------
    mapping of str to (str, str)
        By loser, in table order: the winner, and whether its lead is more than chance. A loser to
        which no label without a counterpart is better is left out. A winner has every score that
        the loser has.
    """
    scored = cells(results, metric)
    published = results.layout.page.published_models
    losers = [label for label in scored.labels if label in published]
    winners = [label for label in scored.labels if label not in published]
    by_pair = contrasts(scored)
    strongest: dict[str, str] = {}
    for loser, winner in product(losers, winners):
        least = by_pair[strongest[loser], loser].advantage if loser in strongest else 0.0
        if scored.covers(winner, loser) and by_pair[winner, loser].advantage > least:
            strongest[loser] = winner
    return {
        loser: (winner, _describe_test(by_pair[winner, loser], scored.unit))
        for loser, winner in strongest.items()
    }


def _describe_test(contrast: PairContrast, unit: str) -> str:
    if not contrast.tested:
        return too_few_units(contrast.n, unit)
    return str((Place.BEHIND if contrast.separable else Place.INSEPARABLE).value)
