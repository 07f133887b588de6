"""The page of a filled file: one HTML file that contains everything and needs no network."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import pandas as pd

from mocapbench.reports.bundle.pictures import Axes, Illustration
from mocapbench.reports.figures.pictures.curves import draw
from mocapbench.reports.filling.curves import (
    MOTION_STYLES,
    FilledCurve,
    draw_curve,
    draw_legend,
)
from mocapbench.reports.resources import fill_template, styles
from mocapbench.reports.text import decimals, number

__all__ = ["FilledPage", "render_filled"]


@dataclass(frozen=True, eq=False)
class FilledPage:
    """Everything that the page shows.

    Parameters
    ----------
    file : str
        Name of the file.
    headline : str
        Which model filled how much, and why this one.
    verdict : tuple of str
        For each kind of gap, whether the lead of a model is more than chance.
    remarks : tuple of str
        What was cut into windows, left open or shortened, and what failed.
    faults : tuple of (str, str, str, str)
        What is wrong at gaps: what it is, of which markers, in which frames, and how large.
    curves : tuple of FilledCurve
    caption : str
        Which gaps the curves show.
    gaps : DataFrame
        All gaps, a row each, as text.
    options : str
        How to leave a gap open, or to fill it otherwise.
    motion : Axes or None
        Stick figures.
    rankings : mapping of str to DataFrame
        By what is to be said of a kind of gap, a row a model, the best first: its name, its error
        in the unit that the column names, and a note.
    left_out : tuple of (str, str)
        Models without a rank, each with the reason.
    command : str
        The command that made the page.
    """

    file: str
    headline: str
    verdict: tuple[str, ...]
    remarks: tuple[str, ...]
    faults: tuple[tuple[str, str, str, str], ...]
    curves: tuple[FilledCurve, ...]
    caption: str
    gaps: pd.DataFrame
    options: str
    motion: Axes | None
    rankings: Mapping[str, pd.DataFrame]
    left_out: tuple[tuple[str, str], ...]
    command: str


def render_filled(page: FilledPage) -> str:
    """Return the page of a filled file as one self-contained HTML page."""
    return fill_template(
        "page.html.j2",
        "mocapbench.reports.filling",
        page=page,
        curves=[draw_curve(curve) for curve in page.curves],
        legend=draw_legend(),
        motion=draw(_illustrate_motion(page.motion), MOTION_STYLES) if page.motion else None,
        rankings={kind: _format_ranking(one) for kind, one in page.rankings.items()},
        css=styles(),
    )


def _illustrate_motion(motion: Axes) -> Illustration:
    return Illustration("filled", "Motion", "", (motion,))


def _format_ranking(ranking: pd.DataFrame) -> pd.DataFrame:
    """Return a ranking as text, its errors with equal decimals."""
    error = ranking.columns[1]
    n_decimals = decimals(ranking[error])
    return ranking.assign(**{error: [number(each, n_decimals) for each in ranking[error]]})
