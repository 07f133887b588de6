"""Models that the paper lacks and whose mean is better than that of one of the paper's models."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

from mocapbench.reports.analysis.cells import cells
from mocapbench.reports.analysis.contrasts import PairContrast, contrasts
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import Place, too_few_units

__all__ = ["Win", "wins"]


@dataclass(frozen=True)
class Win:
    """A model that the paper lacks, better than one of its models.

    Parameters
    ----------
    winner, loser : str
        Labels; the paper has a counterpart of the loser and none of the winner.
    unit : str
        What the units of the contrast are.
    contrast : PairContrast
        Of the winner and the loser over the units that both have.
    """

    winner: str
    loser: str
    unit: str
    contrast: PairContrast

    @property
    def finding(self) -> str:
        """Whether the lead is more than chance."""
        if not self.contrast.tested:
            return too_few_units(self.contrast.n, self.unit)
        place = Place.BEHIND if self.contrast.separable else Place.INSEPARABLE
        return place.value


def wins(results: TaskResults, metric: str) -> list[Win]:
    """Return, for each label with a published counterpart, the best label without one.

    Returns
    -------
    list of Win
        By loser in table order; none where no label without a counterpart has a better mean. A
        winner has every score that the loser has.
    """
    scored = cells(results, metric)
    published = results.layout.page.published_models
    losers = [label for label in scored.labels if label in published]
    winners = [label for label in scored.labels if label not in published]
    by_pair = contrasts(scored)
    strongest: dict[str, Win] = {}
    for loser, winner in product(losers, winners):
        least = strongest[loser].contrast.advantage if loser in strongest else 0.0
        if scored.covers(winner, loser) and by_pair[winner, loser].advantage > least:
            strongest[loser] = Win(winner, loser, scored.unit, by_pair[winner, loser])
    return [strongest[loser] for loser in losers if loser in strongest]
