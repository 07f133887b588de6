"""From an illustration of any kind to a drawing of the page."""

from __future__ import annotations

from functools import singledispatch

from mocapbench.reports.bundle.pictures import HeatMaps, Illustration, Picture, Space
from mocapbench.reports.figures import heat_maps, panels, spaces
from mocapbench.reports.figures.panels import Drawing

__all__ = ["draw"]


@singledispatch
def draw(illustration: Picture) -> Drawing:
    """Return the drawing of ``illustration``.

    Raises
    ------
    TypeError
        If it is of a kind that nothing here draws.
    """
    raise TypeError(
        f"expected an Illustration, HeatMaps or a Space, got {type(illustration).__name__}"
    )


draw.register(Illustration, panels.draw)
draw.register(HeatMaps, heat_maps.draw)
draw.register(Space, spaces.draw)
