"""What the page of a filled file shows, as plain values."""

from __future__ import annotations

from dataclasses import dataclass

from mocapbench.basics.arrays import Array
from mocapbench.reports.bundle.panels import Panel

__all__ = ["FILLED_FRAMES", "GIVEN_FRAMES", "FilledCurve", "FilledPage", "RankedModel"]

FILLED_FRAMES, GIVEN_FRAMES = "filled", "in the file"
"""The groups of the figures of a motion: with filled entries, and without."""


@dataclass(frozen=True, eq=False)
class FilledCurve:
    """A channel around some of its gaps.

    Parameters
    ----------
    channel, unit : str
    times : ndarray of shape (N,)
        Seconds.
    visible, filled : ndarray of shape (N,)
        Values that were there, and that the model put in; NaN where there are none.
    deviation : ndarray of shape (N,)
        Standard deviations of the filled values; NaN where there are none.
    gaps : tuple of (float, float)
        From when until when the channel was filled.
    """

    channel: str
    unit: str
    times: Array
    visible: Array
    filled: Array
    deviation: Array
    gaps: tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class RankedModel:
    """A model in the ranking.

    Parameters
    ----------
    name : str
    error : float
        Weighted mean error over the held-out gaps, relative to that of holding the last visible
        pose.
    rmse : tuple of float
        By unit, in the order of ``FilledPage.units``.
    seconds : float
    note : str
        Such as that it shares the first rank.
    """

    name: str
    error: float
    rmse: tuple[float, ...]
    seconds: float
    note: str


@dataclass(frozen=True, eq=False)
class FilledPage:
    """Everything that the page shows.

    Parameters
    ----------
    file : str
        Name of the file.
    headline : str
        Which model filled how much, and why this one.
    verdict : str
        Whether its lead is more than chance; empty if no gap was held out.
    remarks : tuple of str
        What was cut into windows, left open or shortened, and what failed.
    curves : tuple of FilledCurve
    caption : str
        Which gaps the curves show.
    motion : Panel or None
        Stick figures.
    units : tuple of str
        The units of the errors.
    n : int
        The number of held-out gaps.
    ranking : tuple of RankedModel
    left_out : tuple of (str, str)
        Models without a rank, each with the reason.
    command : str
        The command that made the page.
    """

    file: str
    headline: str
    verdict: str
    remarks: tuple[str, ...]
    curves: tuple[FilledCurve, ...]
    caption: str
    motion: Panel | None
    units: tuple[str, ...]
    n: int
    ranking: tuple[RankedModel, ...]
    left_out: tuple[tuple[str, str], ...]
    command: str
