"""Draw a picture of any kind that stands still as a figure of the page."""

from __future__ import annotations

from collections.abc import Mapping
from functools import singledispatch

from mocapbench.reports.bundle.pictures import HeatMaps, Illustration, Space
from mocapbench.reports.figures.pictures import curves, heat_maps, spaces
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import SvgFigure

__all__ = ["draw"]

Still = Illustration | HeatMaps | Space


@singledispatch
def draw(picture: Still, models: Mapping[str, DrawingStyle]) -> SvgFigure:
    """Return ``picture`` as a figure of the page, models in their styles.

    Raises
    ------
    TypeError
        If it is none of the kinds of picture that stand still.
    """
    del models
    raise TypeError(f"expected an Illustration, HeatMaps or a Space, got {type(picture).__name__}")


draw.register(Illustration, curves.draw)
draw.register(HeatMaps, heat_maps.draw)
draw.register(Space, spaces.draw)
