"""Line styles and markers, which distinguish the series of a figure without colour."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any, Literal, TypeVar

from markupsafe import Markup
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from mocapbench.reports.figures.svg import svg_element

__all__ = ["LINES", "MARKERS", "SMALLEST_SCALE", "cycled", "line_swatch"]

MARKERS = ["o", "s", "^", "D", "v", "P", "X", "<", ">", "p"]
LINES: list[Literal["-", "--", ":", "-."]] = ["-", "--", ":", "-."]
SMALLEST_SCALE = 0.7
"""How far a page narrower than a figure shrinks it before it scrolls."""

_ANY_PREFIX = "any-prefix"

StyleT = TypeVar("StyleT", bound=str)


def cycled(styles: Sequence[StyleT], place: int) -> StyleT:
    """Return the style of the series at ``place``; styles repeat after the last."""
    return styles[place % len(styles)]


def line_swatch(prefix: str, x: Sequence[float] = (0.0, 1.0), **style: Any) -> Markup:
    """Return a short horizontal line through the points ``x`` as an SVG element.

    Parameters
    ----------
    prefix : str
        Start of the element's ids.
    x : sequence of float
        From 0 to 1.
    **style
        Properties of `matplotlib.lines.Line2D`.
    """
    drawn = _drawn_line(tuple(x), tuple(sorted(style.items())))
    return Markup(drawn.replace(_ANY_PREFIX, prefix))


@cache  # a page has hundreds, and few that differ
def _drawn_line(x: tuple[float, ...], style: tuple[tuple[str, Any], ...]) -> str:
    figure = Figure(figsize=(0.34, 0.14))
    figure.add_artist(Line2D(x, [0.5] * len(x), **dict(style)))
    return str(svg_element(figure, _ANY_PREFIX, aria_hidden="true"))
