"""How far a model is behind the best, and whether that is more than chance."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mocapbench.reports.analysis.standings import Standing, StandingKind
from mocapbench.reports.scores.table import NO_SCORE, ScoreCell
from mocapbench.reports.text import number

__all__ = ["behind_cell", "mean_cell"]


def mean_cell(
    means: Sequence[float], n_cases: int, standing: Standing | None, places: int, link: str
) -> ScoreCell:
    """Return the mean of ``means``, bold where it is the best of all.

    A model that lacks cases says how many it has: they may be the easy ones.
    """
    if not means:
        return NO_SCORE
    best = standing is not None and standing.standing is StandingKind.BEST
    note = "" if len(means) == n_cases else f"{len(means)} of {n_cases} cases"
    mean = float(np.mean(means))
    return ScoreCell(number(mean, places), mean, "best" if best else "", note, link)


def behind_cell(standing: Standing | None, places: int) -> ScoreCell:
    """Return by how much a mean is worse than the best, with its interval where there is one.

    A difference that may be chance is marked.
    """
    if standing is None or standing.standing is StandingKind.BEST:
        return ScoreCell("")
    if standing.standing is StandingKind.INCOMPLETE:
        return NO_SCORE
    mark = "≈ " if standing.standing is StandingKind.INSEPARABLE else ""
    text = f"{mark}+{number(standing.difference, places)}"
    kind = "tied" if mark else ""
    if math.isnan(standing.low):
        return ScoreCell(text, standing.difference, kind)
    low, high = number(standing.low, places), number(standing.high, places)
    return ScoreCell(text, standing.difference, kind, f"{low} to {high}")
