"""Marks: the few SVG elements that all figures are made of.

Marks are strings. Colours are the page's: a mark takes the colour of the group that it is in, which
is that of a model. Coordinates are pixels with at most one decimal.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from markupsafe import Markup, escape

from mocapbench.basics.arrays import Array
from mocapbench.reports.figures.styles import DrawingStyle

__all__ = [
    "SHAPES",
    "band",
    "coordinate",
    "disc",
    "dot",
    "group",
    "horizontal",
    "outline",
    "polyline",
    "rectangle",
    "segments",
    "squares",
    "svg",
    "text",
    "vertical",
]


PHONE = 400.0
"""Wider drawings, in pixels, do not shrink to the width of a phone; they scroll."""
SHAPES = (
    "m-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0z",  # circle
    "m-3.6-3.6h7.2v7.2h-7.2z",  # square
    "m0-5l4.7 8h-9.4z",  # triangle
    "m0-5.2l4.6 5.2l-4.6 5.2l-4.6-5.2z",  # diamond
    "m0 5l4.7-8h-9.4z",  # triangle on its tip
    "m-1.6-4.8h3.2v3.2h3.2v3.2h-3.2v3.2h-3.2v-3.2h-3.2v-3.2h3.2z",  # cross
)
"""Outlines of the markers around their place."""


def coordinate(value: float) -> str:
    """Return a coordinate with at most one decimal."""
    return f"{value:z.1f}".removesuffix(".0")


def segments(xs: Array, ys: Array) -> str:
    """Return the commands of a line through points, each relative to the last one."""
    gaps = np.flatnonzero(np.isnan(xs) | np.isnan(ys))
    runs = np.split(np.stack([xs, ys], axis=1), gaps)
    whole = (run[~np.isnan(run).any(axis=1)] for run in runs)
    return "".join(outline(run) for run in whole if len(run))


def outline(points: Array) -> str:
    """Return a line through points in tenths of a pixel, which add up without rounding error."""
    tenths = np.rint(points * 10.0).astype(int)
    steps = np.diff(tenths, axis=0)
    first = " ".join(coordinate(value / 10) for value in tenths[0])
    return f"M{first}" + ("l" if len(steps) else "") + _join_numbers(steps.ravel().tolist())


def _join_numbers(tenths: Sequence[int]) -> str:
    """Return numbers side by side, separated only where they would run into each other."""
    first, *others = [_tenths(value) for value in tenths] or [""]
    return first + "".join(n if n.startswith("-") else f" {n}" for n in others)


def _tenths(value: int) -> str:
    """Return a number of tenths, without the zero before its point."""
    return f"{value / 10:g}".replace("0.", ".") if abs(value) < 10 else f"{value / 10:g}"


def dot(x: float, y: float, shape: int = 0, kind: str = "dot") -> str:
    """Return a marker."""
    return f'<path class="{kind}" d="M{coordinate(x)} {coordinate(y)}{SHAPES[shape]}"/>'


def disc(x: float, y: float, radius: float, title: str = "") -> str:
    """Return a disc; the page shows ``title`` beside the pointer."""
    at = f'cx="{coordinate(x)}" cy="{coordinate(y)}" r="{coordinate(radius)}"'
    tooltip = f"<title>{escape(title)}</title>" if title else ""
    return f'<circle class="disc" {at}>{tooltip}</circle>'


def horizontal(x: float, end: float, y: float, kind: str = "interval") -> str:
    """Return a horizontal line."""
    return f'<path class="{kind}" d="M{coordinate(x)} {coordinate(y)}H{coordinate(end)}"/>'


def vertical(xs: Iterable[float], y: float, end: float, kind: str = "fold") -> str:
    """Return vertical lines of one length as one mark."""
    top, down = coordinate(y), coordinate(end - y)
    return f'<path class="{kind}" d="{"".join(f"M{coordinate(x)} {top}v{down}" for x in xs)}"/>'


def polyline(xs: Array, ys: Array, kind: str = "line") -> str:
    """Return a line through points; NaN breaks it.

    Parameters
    ----------
    xs, ys : ndarray of shape (N,)
    kind : str
        Its class.
    """
    return f'<path class="{kind}" d="{segments(xs, ys)}"/>'


def band(xs: Array, low: Array, high: Array) -> str:
    """Return the area between two lines; NaN ends it."""
    known = ~(np.isnan(xs) | np.isnan(low) | np.isnan(high))
    steps = np.flatnonzero(np.diff(known.astype(int))) + 1
    runs = (run for run in np.split(np.arange(len(xs)), steps) if len(run) and known[run[0]])
    outlines = (
        outline(np.stack([np.r_[xs[r], xs[r][::-1]], np.r_[low[r], high[r][::-1]]], axis=1)) + "z"
        for r in runs
    )
    return f'<path class="band" d="{"".join(outlines)}"/>'


def rectangle(x: float, y: float, width: float, height: float, kind: str) -> str:
    """Return a rectangle."""
    sides = f"h{coordinate(width)}v{coordinate(height)}h{coordinate(-width)}z"
    return f'<path class="{kind}" d="M{coordinate(x)} {coordinate(y)}{sides}"/>'


def squares(corners: Iterable[tuple[float, float]], side: float, kind: str) -> str:
    """Return squares of one size, by their upper left corners, as one mark."""
    sides = f"h{coordinate(side)}v{coordinate(side)}h{coordinate(-side)}z"
    commands = (f"M{coordinate(x)} {coordinate(y)}{sides}" for x, y in corners)
    return f'<path class="{kind}" d="{"".join(commands)}"/>'


def text(x: float, y: float, content: str, kind: str = "") -> str:
    """Return a text; the classes ``end`` and ``middle`` align it."""
    of_kind = f' class="{kind}"' if kind else ""
    return f'<text{of_kind} x="{coordinate(x)}" y="{coordinate(y)}">{escape(content)}</text>'


def group(style: DrawingStyle, *marks: str, title: str = "") -> str:
    """Return the marks of one model, in its colour; the page shows ``title`` beside the pointer."""
    tooltip = f"<title>{escape(title)}</title>" if title else ""
    return f'<g class="{style.classes}"{style.model}>{tooltip}{"".join(marks)}</g>'


def svg(width: float, height: float, label: str, marks: Iterable[str]) -> Markup:
    """Return a drawing with an accessible name."""
    size = f'viewBox="0 0 {coordinate(width)} {coordinate(height)}" width="{coordinate(width)}"'
    kind = "plot wide" if width > PHONE else "plot"
    return Markup(  # the marks escape what they are given
        f'<svg class="{kind}" {size} height="{coordinate(height)}" role="img" '
        f'aria-label="{escape(label)}">{"".join(marks)}</svg>'
    )
