"""A figure of the page: an SVG element with its heading, legend and caption."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from markupsafe import Markup

from mocapbench.reports.figures.marks import dot, horizontal
from mocapbench.reports.figures.styles import DrawingStyle

__all__ = ["Key", "SvgFigure", "dot_keys", "key", "line_keys"]

Key = tuple[str, Markup, str]
"""An entry of a legend: its label, an SVG element in the style of what the label names, and the
model by which a script highlights it, empty where it is of none."""

_WIDTH, _MIDDLE = 28.0, 7.0


@dataclass(frozen=True)
class SvgFigure:
    """A drawn figure.

    Parameters
    ----------
    title : str
    svg : Markup
        One SVG element, or several side by side.
    legend : tuple of Key
        Text of the page, so that it wraps on a narrow screen while the SVG scales.
    caption : str
    """

    title: str
    svg: Markup
    legend: tuple[Key, ...]
    caption: str


def line_keys(styles: Mapping[str, DrawingStyle]) -> tuple[Key, ...]:
    """Return a key with a line for each style, by its name."""
    return tuple(key(name, style, _line()) for name, style in styles.items())


def dot_keys(styles: Iterable[DrawingStyle]) -> tuple[Key, ...]:
    """Return a key with a marker for each style, named by its label."""
    return tuple(
        key(style.label, style, dot(_WIDTH / 2.0, _MIDDLE, style.shape)) for style in styles
    )


def key(label: str, style: DrawingStyle, *marks: str) -> Key:
    """Return a key that shows ``marks`` in the colour of ``style``."""
    swatch = f'<svg class="swatch {style.classes}" aria-hidden="true">{"".join(marks)}</svg>'
    return label, Markup(swatch), style.label  # marks are numbers


def _line() -> str:
    return horizontal(0.0, _WIDTH, _MIDDLE, "line")
