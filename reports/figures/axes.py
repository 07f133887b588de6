"""Axes around marks: one drawing of a figure."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from markupsafe import Markup

from mocapbench.reports.figures.marks import horizontal, svg, text, vertical
from mocapbench.reports.figures.scale import Scale
from mocapbench.reports.text import MINUS

__all__ = [
    "BOTTOM",
    "LEFT",
    "TOP",
    "WIDTH",
    "bottom_axis",
    "draw_axes",
    "format_tick",
    "left_axis",
    "names",
    "panels",
]

WIDTH = 340.0
"""Of a panel, in pixels: it fits a phone."""
LEFT, RIGHT, TOP, BOTTOM = 48.0, 12.0, 36.0, 36.0
LETTER = 5.8
"""Width of a letter, in pixels."""
_POWERS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def draw_axes(
    scales: tuple[Scale, Scale],
    title: str,
    names: tuple[str, str],
    marks: Iterable[str],
    label: str,
) -> Markup:
    """Return two axes around marks.

    Parameters
    ----------
    scales : (Scale, Scale)
        Of x and of y. Their places are those in the drawing: y starts at its lower end.
    title : str
        Heading.
    names : (str, str)
        The quantity along each axis with its unit.
    marks : iterable of str
    label : str
        Accessible name.
    """
    x, y = scales
    return svg(
        x.stop + RIGHT,
        y.start + BOTTOM,
        label,
        [
            text(0.0, 13.0, title, "title"),
            text(0.0, 27.0, names[1]),
            left_axis(y, x.start, x.stop),
            bottom_axis(x, y.start, names[0]),
            *marks,
        ],
    )


def panels(drawings: Iterable[Markup]) -> Markup:
    """Return drawings side by side, as many in a row as the page has room for."""
    return Markup('<div class="panels">{}</div>').format(Markup("").join(drawings))


def bottom_axis(scale: Scale, y: float, label: str) -> str:
    """Return an axis along the bottom at ``y``, its ticks and its label."""
    ticks = scale.ticks()
    return "".join(
        [
            horizontal(scale.start, scale.stop, y, "axis"),
            vertical(map(scale.place, ticks), y, y + 4.0, "axis"),
            *(text(scale.place(tick), y + 16.0, format_tick(tick), "middle") for tick in ticks),
            _label(scale, y + 31.0, label),
        ]
    )


def _label(scale: Scale, y: float, label: str) -> str:
    """Return the label of an axis in its middle; one that is longer starts at the left edge."""
    if LETTER * len(label) > scale.stop - scale.start:
        return text(0.0, y, label)
    return text((scale.start + scale.stop) / 2.0, y, label, "middle")


def left_axis(scale: Scale, x: float, end: float) -> str:
    """Return lines across the panel at the ticks, from ``x`` to ``end``, and their values."""
    places = [(tick, scale.place(tick)) for tick in scale.ticks()]
    lines = (horizontal(x, end, y, "grid") for _, y in places)
    values = (text(x - 5.0, y + 4.0, format_tick(tick), "end") for tick, y in places)
    return "".join([*lines, *values])


def names(labels: Sequence[str], places: Iterable[float], x: float) -> str:
    """Return names that end at ``x``, one at each place."""
    return "".join(text(x, y + 4.0, n, "end") for n, y in zip(labels, places, strict=True))


def format_tick(tick: float) -> str:
    """Return a tick as text: up to six digits, or a power of ten where it is far from one."""
    mantissa, exponent = f"{tick:e}".split("e")
    if abs(int(exponent)) < 4:
        return f"{tick:.6g}".replace("-", MINUS)
    power = f"10{str(int(exponent)).translate(_POWERS)}"
    factor = f"{float(mantissa):g}".replace("-", MINUS)
    return power if factor == "1" else f"{factor}·{power}"
