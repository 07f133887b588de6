"""Sentences under a score table on its best means: what is tested, and over which units."""

from __future__ import annotations

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import Standing, standings
from mocapbench.reports.analysis.units import FEWEST_UNITS

__all__ = ["rank_notes"]


def rank_notes(results: TaskResults, metric: str) -> tuple[str, ...]:
    """Return the notes under a table whose best means are in bold."""
    leaders = _leaders(results, metric)
    if not leaders:
        return ()
    few = list(dict.fromkeys(best.units for best in leaders if best.n_units < FEWEST_UNITS))
    untested = (
        f"Too few to test: rows over {' or '.join(few)}. A test of two entrants in a row needs "
        f"{FEWEST_UNITS} independent units."
    )
    return ("Bold: the best mean of a row.", *([untested] if few else []))


def _leaders(results: TaskResults, metric: str) -> list[Standing]:
    by_case = (standings(results, metric, [case]) for case in results.cases)
    return [found[0] for found in by_case if found]
