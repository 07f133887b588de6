"""Draw a picture of any kind as a figure of the page."""

from __future__ import annotations

from collections.abc import Mapping
from functools import singledispatch

from mocapbench.reports.bundle.pictures import HeatMaps, Illustration, Motions, Picture, Space
from mocapbench.reports.figures.pictures import heat_maps, panels, spaces
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import SvgFigure
from mocapbench.reports.motions import player
from mocapbench.reports.motions.player import PlayerFigure

__all__ = ["draw"]


@singledispatch
def draw(picture: Picture, models: Mapping[str, DrawingStyle]) -> SvgFigure | PlayerFigure:
    """Return ``picture`` as a figure of the page, models in their styles.

    Raises
    ------
    TypeError
        If it is none of the kinds of picture.
    """
    del models
    raise TypeError(
        f"expected an Illustration, HeatMaps, a Space or Motions, got {type(picture).__name__}"
    )


draw.register(Illustration, panels.draw)
draw.register(HeatMaps, heat_maps.draw)
draw.register(Space, spaces.draw)


@draw.register
def _(picture: Motions, models: Mapping[str, DrawingStyle]) -> PlayerFigure:
    """Return a player, in which two hues tell the motions apart that are shown."""
    del models
    return player.draw(picture)
