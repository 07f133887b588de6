"""The page of a filled file: one HTML file that contains everything and needs no network."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from mocapbench.reports.bundle.pictures import Axes, Illustration
from mocapbench.reports.figures.pictures.curves import draw
from mocapbench.reports.filling.curves import (
    MOTION_STYLES,
    FilledCurve,
    draw_curve,
    draw_legend,
)
from mocapbench.reports.resources import styles, template
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
    verdict : str
        Whether its lead is more than chance; empty if no gap was held out.
    remarks : tuple of str
        What was cut into windows, left open or shortened, and what failed.
    curves : tuple of FilledCurve
    caption : str
        Which gaps the curves show.
    motion : Axes or None
        Stick figures.
    units : tuple of str
        The units of the errors.
    n_gaps : int
        The number of held-out gaps.
    errors : mapping of str to float
        Of each model in the ranking, the best first: the weighted mean error over the held-out
        gaps, relative to that of holding the last visible value.
    rmse : mapping of str to mapping of str to float
        Of each of these models, the root mean squared error by unit.
    seconds : mapping of str to float
        What a hold-out took each of them.
    notes : mapping of str to str
        Such as that it shares the first rank.
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
    motion: Axes | None
    units: tuple[str, ...]
    n_gaps: int
    errors: Mapping[str, float]
    rmse: Mapping[str, Mapping[str, float]]
    seconds: Mapping[str, float]
    notes: Mapping[str, str]
    left_out: tuple[tuple[str, str], ...]
    command: str


def render_filled(page: FilledPage) -> str:
    """Return the page of a filled file as one self-contained HTML page."""
    return template("page.html.j2", "mocapbench.reports.filling").render(
        page=page,
        curves=[draw_curve(curve) for curve in page.curves],
        legend=draw_legend(),
        motion=draw(_illustrate_motion(page.motion), MOTION_STYLES) if page.motion else None,
        rows=_format_ranking(page),
        css=styles(),
    )


def _illustrate_motion(motion: Axes) -> Illustration:
    return Illustration("filled", "Motion", "", (motion,))


def _format_ranking(page: FilledPage) -> list[tuple[str, ...]]:
    """Return the cells of the ranking, its numbers with equal decimals in a column."""
    n_decimals = decimals(page.errors.values())
    in_unit = {
        unit: decimals(page.rmse[model][unit] for model in page.errors) for unit in page.units
    }
    return [
        (
            model,
            number(error, n_decimals),
            *(number(page.rmse[model][unit], in_unit[unit]) for unit in page.units),
            number(page.seconds[model], 1),
            page.notes[model],
        )
        for model, error in page.errors.items()
    ]
