"""From an illustration to a drawing of the page: its panels, and a legend as text of the page."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from markupsafe import Markup
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from mocapbench.reports.bundle.pictures import Illustration, Panel
from mocapbench.reports.figures.error_bars import LINES, SMALLEST_SCALE, Key
from mocapbench.reports.figures.svg import PALETTE, STYLE, element
from mocapbench.reports.tables.base import counted, slug

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["Drawing", "draw"]

WIDTH, PANEL_HEIGHT = 5.2, 2.0
LINE_WIDTH = 1.1

Look = Mapping[str, Any]


@dataclass(frozen=True)
class Drawing:
    """An illustration as an SVG element, with its heading, legend and caption."""

    title: str
    svg: Markup
    legend: tuple[Key, ...]
    caption: str


def draw(illustration: Illustration) -> Drawing:
    """Return the drawing of ``illustration``; colour and dashes tell its groups apart."""
    prefix = slug(illustration.task, illustration.title, "drawing")
    looks = {group: _look(place) for place, group in enumerate(illustration.groups)}
    with rc_context(STYLE):
        return Drawing(
            illustration.title,
            _panels(illustration, looks, prefix),
            tuple(
                Key(group, _swatch(look, f"{prefix}-key-{place}"))
                for place, (group, look) in enumerate(looks.items())
            ),
            illustration.caption,
        )


def _look(place: int) -> Look:
    colour, dashes = PALETTE[place % len(PALETTE)], LINES[place % len(LINES)]
    return {"color": colour, "linestyle": dashes, "linewidth": LINE_WIDTH}


def _panels(illustration: Illustration, looks: Mapping[str, Look], prefix: str) -> Markup:
    n_panels = len(illustration.panels)
    figure = Figure(figsize=(WIDTH, PANEL_HEIGHT * n_panels), layout="constrained")
    rows = figure.subplots(n_panels, squeeze=False)[:, 0]
    for axes, panel in zip(rows, illustration.panels, strict=True):
        _draw_panel(axes, panel, looks)
    return element(
        figure,
        prefix,
        role="img",
        aria_label=f"{illustration.title}: {counted(n_panels, 'panel')}",
        style=f"min-width: {SMALLEST_SCALE * WIDTH:.2f}in",
    )


def _draw_panel(axes: Axes, panel: Panel, looks: Mapping[str, Look]) -> None:
    for band in panel.bands:
        colour = looks[band.group]["color"]
        axes.fill_between(band.x, band.low, band.high, color=colour, alpha=0.2, linewidth=0.0)
    for curve in panel.curves:
        axes.plot(curve.x, curve.y, **looks[curve.group])
    axes.set(xlabel=panel.x_label, ylabel=panel.y_label)
    axes.set_aspect("equal" if panel.spatial else "auto")
    axes.set_title(panel.title, fontsize=10, loc="left")
    axes.grid(axis="y", linewidth=0.6)
    axes.margins(x=0.01)


def _swatch(look: Look, prefix: str) -> Markup:
    figure = Figure(figsize=(0.34, 0.14))
    figure.add_artist(Line2D([0.0, 1.0], [0.5, 0.5], **look))
    return element(figure, prefix, aria_hidden="true")
