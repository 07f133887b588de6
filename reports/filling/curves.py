"""Draw filled channels, their gaps shaded."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from markupsafe import Markup
from matplotlib import rc_context
from matplotlib.figure import Figure

from mocapbench.reports.figures.line_styles import SMALLEST_SCALE, line_swatch
from mocapbench.reports.figures.svg import LEVELS, PALETTE, STYLE, svg_element
from mocapbench.reports.figures.svg_figure import Key
from mocapbench.reports.filling.values import FilledCurve
from mocapbench.reports.printable import printable
from mocapbench.reports.text import counted

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["draw_curve", "legend"]

WIDTH, HEIGHT = 5.2, 1.9
VISIBLE, FILLED = PALETTE[0], PALETTE[1]
SHADE = LEVELS[3]
_WITHIN_95 = 1.96


def draw_curve(curve: FilledCurve, prefix: str) -> Markup:
    """Return a channel as an SVG element; the ids of its parts start with ``prefix``."""
    with rc_context(STYLE):
        figure = Figure(figsize=(WIDTH, HEIGHT), layout="constrained")
        _draw(figure.subplots(), curve)
        return svg_element(
            figure,
            prefix,
            role="img",
            aria_label=_described(curve),
            style=f"min-width: {SMALLEST_SCALE * WIDTH:.2f}in",
        )


def _described(curve: FilledCurve) -> str:
    gaps = counted(len(curve.gaps), "filled gap")
    return f"{printable(curve.channel)} over time, with {gaps}"


def legend() -> tuple[Key, ...]:
    """Return the keys that all curves share."""
    return (
        Key("in the file", line_swatch("key-visible", color=VISIBLE, linestyle="-")),
        Key(
            "filled, with its 95 % band if there is one",
            line_swatch("key-filled", color=FILLED, linestyle="--"),
        ),
        Key("gap", line_swatch("key-gap", color=SHADE, linewidth=8.0)),
    )


def _draw(axes: Axes, curve: FilledCurve) -> None:
    for first, last in curve.gaps:
        axes.axvspan(first, last, color=SHADE, alpha=0.5, linewidth=0.0)
    half = _WITHIN_95 * curve.deviation
    low, high = curve.filled - half, curve.filled + half
    axes.fill_between(curve.times, low, high, color=FILLED, alpha=0.25, linewidth=0.0)
    axes.plot(curve.times, curve.visible, color=VISIBLE, linewidth=1.1)
    axes.plot(curve.times, _joined(curve), color=FILLED, linewidth=1.3, linestyle="--")
    axes.set(xlabel="time, s", ylabel=printable(curve.unit))
    axes.set_title(printable(curve.channel), fontsize=10, loc="left")
    axes.grid(axis="y", linewidth=0.6)
    axes.margins(x=0.01)


def _joined(curve: FilledCurve) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """Return the filled values, joined to the visible ones beside them."""
    filled = ~np.isnan(curve.filled)
    beside = np.zeros_like(filled)
    beside[:-1] |= filled[1:]
    beside[1:] |= filled[:-1]
    return np.where(beside & ~filled, curve.visible, curve.filled)
