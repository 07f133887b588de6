"""Headlines on models that the paper lacks and that are better than the paper's models.

Such a model is often a simple baseline. For each of the paper's models only the best of them is
named, with what a paired test says of the lead.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.wins import Win, wins
from mocapbench.reports.page.headline import Headline

__all__ = ["win_headlines"]


def win_headlines(results: TaskResults, metric: str) -> list[Headline]:
    """Name each model that the paper lacks with the paper's models that it is better than."""
    found = sorted(wins(results, metric), key=lambda win: results.layout.labels.index(win.winner))
    return [_headline(winner, list(group)) for winner, group in groupby(found, lambda w: w.winner)]


def _headline(winner: str, group: Sequence[Win]) -> Headline:
    by_test: dict[str, list[str]] = {}
    for win in group:
        by_test.setdefault(win.finding, []).append(win.loser)
    losers = "; ".join(f"{', '.join(names)}, {finding}" for finding, names in by_test.items())
    return Headline(winner, f"has a better mean than {losers}.")
