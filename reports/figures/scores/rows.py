"""Rows of a figure, one a model, with its name on the left."""

from __future__ import annotations

from mocapbench.reports.figures.marks import group, text
from mocapbench.reports.figures.styles import DrawingStyle

__all__ = ["NAMES", "ROW", "TOP", "place_of", "row"]

NAMES, ROW, TOP = 152.0, 17.0, 24.0
"""Width of the names, height of a row, and of the heading, in pixels."""
_LONGEST = 24


def place_of(number: int) -> float:
    """Return the middle of a row, counted from 0."""
    return TOP + (number + 0.5) * ROW


def row(style: DrawingStyle, number: int, *marks: str, title: str = "", name: str = "") -> str:
    """Return the marks of one row with the name of its model; ``title`` says its numbers."""
    written = name or style.label
    short = written if len(written) <= _LONGEST else f"{written[: _LONGEST - 1]}…"
    named = text(NAMES - 10.0, place_of(number) + 4.0, short, "end name")
    return group(style, named, *marks, title=title)
