"""Draw panels of curves."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from markupsafe import Markup
from matplotlib import rc_context
from matplotlib.figure import Figure

from mocapbench.reports.bundle.panels import Illustration, Panel
from mocapbench.reports.figures.line_styles import LINES, SMALLEST_SCALE, cycled, line_swatch
from mocapbench.reports.figures.svg import PALETTE, STYLE, svg_element
from mocapbench.reports.figures.svg_figure import Key, SvgFigure
from mocapbench.reports.text import counted, slug

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["draw"]

WIDTH, PANEL_HEIGHT = 5.2, 2.0
LINE_WIDTH = 1.1

Style = Mapping[str, Any]


def draw(illustration: Illustration) -> SvgFigure:
    """Return ``illustration`` as a figure; colours and dashes distinguish its groups."""
    prefix = slug(illustration.task, illustration.title, "drawing")
    styles = {group: _style(place) for place, group in enumerate(illustration.groups)}
    with rc_context(STYLE):
        return SvgFigure(
            illustration.title,
            _panels(illustration, styles, prefix),
            tuple(
                Key(group, line_swatch(f"{prefix}-key-{place}", **style))
                for place, (group, style) in enumerate(styles.items())
            ),
            illustration.caption,
        )


def _style(place: int) -> Style:
    return {
        "color": cycled(PALETTE, place),
        "linestyle": cycled(LINES, place),
        "linewidth": LINE_WIDTH,
    }


def _panels(illustration: Illustration, styles: Mapping[str, Style], prefix: str) -> Markup:
    n_panels = len(illustration.panels)
    figure = Figure(figsize=(WIDTH, PANEL_HEIGHT * n_panels), layout="constrained")
    rows = figure.subplots(n_panels, squeeze=False)[:, 0]
    for axes, panel in zip(rows, illustration.panels, strict=True):
        _draw_panel(axes, panel, styles)
    return svg_element(
        figure,
        prefix,
        role="img",
        aria_label=f"{illustration.title}: {counted(n_panels, 'panel')}",
        style=f"min-width: {SMALLEST_SCALE * WIDTH:.2f}in",
    )


def _draw_panel(axes: Axes, panel: Panel, styles: Mapping[str, Style]) -> None:
    for band in panel.bands:
        colour = styles[band.group]["color"]
        axes.fill_between(band.x, band.low, band.high, color=colour, alpha=0.2, linewidth=0.0)
    for curve in panel.curves:
        axes.plot(curve.x, curve.y, **styles[curve.group])
    axes.set(xlabel=panel.x_label, ylabel=panel.y_label)
    axes.set_aspect("equal" if panel.spatial else "auto")
    axes.set_title(panel.title, fontsize=10, loc="left")
    axes.grid(axis="y", linewidth=0.6)
    axes.margins(x=0.01)
