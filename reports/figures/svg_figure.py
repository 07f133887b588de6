"""A figure of the page: an SVG element with its heading, legend and caption."""

from __future__ import annotations

from dataclasses import dataclass

from markupsafe import Markup

__all__ = ["Key", "SvgFigure"]


@dataclass(frozen=True)
class Key:
    """One entry of a legend.

    Parameters
    ----------
    label : str
    swatch : Markup
        An SVG element in the style of the series or level that the label names.
    model : str
        The model that it is of, by which a script highlights it; empty where it is of none.
    """

    label: str
    swatch: Markup
    model: str = ""


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
