"""A figure of the page: an SVG element with its heading, legend and caption."""

from __future__ import annotations

from dataclasses import dataclass

from markupsafe import Markup

__all__ = ["Key", "SvgFigure"]


Key = tuple[str, Markup, str]
"""An entry of a legend: its label, an SVG element in the style of what the label names, and the
model by which a script highlights it, empty where it is of none."""


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
