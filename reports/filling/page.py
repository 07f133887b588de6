"""The page: one HTML file that contains everything and needs no network."""

from __future__ import annotations

from mocapbench.reports.bundle.panels import Illustration, Panel
from mocapbench.reports.figures.pictures.panels import draw
from mocapbench.reports.filling.curves import MOTION_STYLES, draw_curve, legend
from mocapbench.reports.filling.values import FilledPage
from mocapbench.reports.resources import styles, template
from mocapbench.reports.text import decimals, number

__all__ = ["render_filled"]


def render_filled(page: FilledPage) -> str:
    """Return the page of a filled file as one self-contained HTML page."""
    return template("page.html.j2", "mocapbench.reports.filling").render(
        page=page,
        curves=[draw_curve(curve) for curve in page.curves],
        legend=legend(),
        motion=draw(_motion(page.motion), MOTION_STYLES) if page.motion else None,
        rows=_rows(page),
        css=styles(),
    )


def _motion(motion: Panel) -> Illustration:
    return Illustration("filled", "Motion", "", (motion,))


def _rows(page: FilledPage) -> list[tuple[str, ...]]:
    """Return the cells of the ranking, its numbers with equal decimals in a column."""
    errors = decimals(model.error for model in page.ranking)
    places = [decimals(column) for column in zip(*(m.rmse for m in page.ranking), strict=True)]
    return [
        (
            model.name,
            number(model.error, errors),
            *(number(value, n) for value, n in zip(model.rmse, places, strict=True)),
            number(model.seconds, 1),
            model.note,
        )
        for model in page.ranking
    ]
