"""How far a model is behind the best, and whether that is more than chance."""

from __future__ import annotations

import math

from mocapbench.reports.analysis.standings import Place, Standing
from mocapbench.reports.scores.table import NO_SCORE, ScoreCell
from mocapbench.reports.text import number

__all__ = ["behind_cell", "mean_cell"]


def mean_cell(
    mean: float, standing: Standing | None, places: int, note: str, link: str
) -> ScoreCell:
    """Return a mean, bold where it is the best of all."""
    best = standing is not None and standing.standing is Place.BEST
    return ScoreCell(number(mean, places), mean, "best" if best else "", note, link)


def behind_cell(standing: Standing | None, places: int) -> ScoreCell:
    """Return by how much a mean is worse than the best, with its interval where there is one.

    A difference that may be chance is marked.
    """
    if standing is None or standing.standing is Place.BEST:
        return ScoreCell("")
    if standing.standing is Place.INCOMPLETE:
        return NO_SCORE
    mark = "≈ " if standing.standing is Place.INSEPARABLE else ""
    text = f"{mark}+{number(standing.difference, places)}"
    kind = "tied" if mark else ""
    if math.isnan(standing.low):
        return ScoreCell(text, standing.difference, kind)
    low, high = number(standing.low, places), number(standing.high, places)
    return ScoreCell(text, standing.difference, kind, f"{low} to {high}")
