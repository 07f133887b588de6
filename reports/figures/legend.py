"""Legends: one key for each series, in the style of its marks."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from markupsafe import Markup

from mocapbench.reports.figures.marks import dot, horizontal
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import Key

__all__ = ["dot_keys", "key", "line_keys"]

_WIDTH, _MIDDLE = 28.0, 7.0


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
