"""The look of figures for papers: the page's colours, markers and dashes, and embedded fonts."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from math import ceil
from textwrap import fill
from typing import Any

import pandas as pd
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from mocapbench.reports.figures.scale import (
    LogScale,
    fit_count_scale,
    fit_linear_scale,
    fit_scale,
)
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.resources import styles as read_style_sheets

__all__ = [
    "EM",
    "LOOKS",
    "MARKERS",
    "NARROW",
    "Styles",
    "add_legend",
    "colour_of",
    "dashes_of",
    "fit_axis",
    "fit_count_axis",
    "fit_legend",
    "legend_handles",
    "level_colours",
    "scale_mark",
    "scales_of",
    "settings_of",
    "shorten_labels",
    "text_size",
    "wrap_text",
]

Styles = Mapping[str, DrawingStyle]

LOOKS = {"paper": (8.0, 8.4), "slides": (16.0, 24.0)}
"""By name, the size of the text in points, and the width in centimetres by default."""
EM = 1.0 / 72.0
"""Inches of a point."""
MARKERS = ("o", "s", "^", "D", "v", "P")
"""In the order of `mocapbench.reports.figures.marks.SHAPES`."""
_DASHED_WIDTH = 1.4
"""Of the page's lines, of which matplotlib takes dashes as multiples."""

NARROW, _LINE = 20, 36
"""Letters in a line of axes beside names of models, and of axes as wide as a column."""
_START, _END = 24, 12
"""Letters of a longer name of a model that are shown, before and after those left out."""

_FIXED = {
    "axes.grid": False,
    "axes.linewidth": 0.6,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlelocation": "left",
    "axes.titlesize": "medium",
    "axes.titleweight": "bold",
    "legend.fontsize": "small",
    "legend.columnspacing": 1.2,
    "legend.labelspacing": 0.35,
    "legend.frameon": False,
    "pdf.fonttype": 42,  # TrueType, embedded: publishers refuse the outlines of Type 3
    "ps.fonttype": 42,
    "savefig.dpi": 300,
    "text.parse_math": False,  # a name with dollars is a name
    "svg.fonttype": "none",  # text stays text
    "svg.hashsalt": "mocapbench",  # ids are the same in every run
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
}


def settings_of(size: float) -> Mapping[str, Any]:
    """Return settings of matplotlib for text of a size in points."""
    return {**_FIXED, "font.size": size, "lines.linewidth": size / 7.0}


def colour_of(style: DrawingStyle) -> str:
    """Return the colour that the page has for a style, on white paper."""
    name = style.hue.removeprefix("h")
    names = {"r": "series-reference", "t": "ink"}
    return _colours()[names.get(name, f"series-{name}")]


def dashes_of(style: DrawingStyle) -> Any:
    """Return the dashes that the page has for lines of a style."""
    found = re.search(rf"\.k{style.shape} > \.line {{ stroke-dasharray: ([\d ]+);", _style_sheets())
    return (0.0, tuple(float(n) / _DASHED_WIDTH for n in found[1].split()) if found else None)


def level_colours() -> list[str]:
    """Return the page's colours of negative to positive values."""
    colours = _colours()
    return [colours[name] for name in sorted(colours) if name.startswith("level-")]


def scales_of(labels: Iterable[str], styles: Styles) -> dict[str, dict[str, Any]]:
    """Return by what seaborn tells labels apart: colours, markers and dashes."""
    chosen = {label: styles[label] for label in dict.fromkeys(labels)}
    return {
        "color": {label: colour_of(style) for label, style in chosen.items()},
        "marker": {label: MARKERS[style.shape] for label, style in chosen.items()},
        "linestyle": {label: dashes_of(style) for label, style in chosen.items()},
    }


def fit_axis(axes: Axes, name: str, values: Iterable[float], ends: Iterable[float] = ()) -> None:
    """Let an axis show values, logarithmic where they are positive and span a factor of ten.

    Seaborn would transform means before it draws, but not the ends of intervals.

    Parameters
    ----------
    axes : Axes
    name : str
        ``"x"`` or ``"y"``.
    values : iterable of float
    ends : iterable of float, optional
        Of intervals, which a linear axis has room for too.
    """
    known = [*values]
    scale = fit_scale(known, 0.0, 1.0)
    if isinstance(scale, LogScale):
        ticks = scale.ticks()
        axes.set(**{f"{name}scale": "log"})
        axes.set(**{f"{name}ticks": ticks, f"{name}ticklabels": [f"{tick:g}" for tick in ticks]})
        getattr(axes, f"{name}axis").minorticks_off()
    else:
        scale = fit_linear_scale([*known, *ends], 0.0, 1.0)
    axes.set(**{f"{name}lim": (scale.low, scale.high)})


def fit_count_axis(axes: Axes, counts: Iterable[float]) -> None:
    """Let the horizontal axis show counts from zero, logarithmic but for that, each at a tick."""
    shown = sorted({*counts})
    scale = fit_count_scale(shown, 0.0, 1.0)
    axes.set_xscale("function", functions=(scale.forward, scale.backward))
    axes.set_xticks(shown, [f"{count:g}" for count in shown])
    axes.set_xlim(scale.low, scale.high)


def shorten_labels(table: pd.DataFrame, styles: Styles) -> tuple[pd.DataFrame, Styles]:
    """Return a table and styles in which names of models leave room for what is drawn.

    Names that would be alike have a number.
    """
    if "label" not in table:
        return table, styles
    shown: dict[str, str] = {}
    for label in dict.fromkeys(table["label"]):
        name = label
        if len(label) > _START + 1 + _END:
            name = f"{label[:_START]}…{label[-_END:]}"
        shown[label] = f"{name} ({len(shown) + 1})" if name in shown.values() else name
    named = {shown.get(label, label): look for label, look in styles.items()}
    return table.assign(label=table["label"].map(shown)), named


def wrap_text(text: str, letters: int = _LINE) -> str:
    """Return a heading in lines of so many letters, by default as a column of a paper has room."""
    return fill(text, letters)


def text_size() -> float:
    """Return the size of text in points that matplotlib is set to."""
    return float(rcParams["font.size"])


def scale_mark(size: float) -> float:
    """Return a size of marks beside text of 8 points in proportion to the text that is set."""
    return size * text_size() / 8.0


def add_legend(figure: Figure, styles: Styles) -> None:
    """Add a legend below all axes, with as many columns as there is room for."""
    if styles:
        columns, _ = fit_legend([*styles], figure.get_figwidth() / (EM * text_size()))
        handles = legend_handles(styles)
        figure.legend(handles=handles, loc="outside lower center", ncols=columns, handlelength=2.6)


def legend_handles(styles: Styles) -> list[Line2D]:
    """Return a line with a marker for each label."""
    return [
        Line2D(
            [],
            [],
            color=colour_of(style),
            linestyle=dashes_of(style),
            marker=MARKERS[style.shape],
            markersize=0.5 * text_size(),
            label=label,
        )
        for label, style in styles.items()
    ]


def fit_legend(labels: Sequence[str], width: float) -> tuple[int, float]:
    """Return how many columns a legend of a width has, and its height, both in em."""
    if not labels:
        return 0, 0.0
    columns = max(1, int(width // (0.48 * max(map(len, labels)) + 4.0)))
    return columns, 1.0 + 1.25 * ceil(len(labels) / columns)


@cache
def _colours() -> Mapping[str, str]:
    """Return the colours of the page by name, those on white paper."""
    light = re.search(r":root {(.*?)}", _style_sheets(), re.DOTALL)
    return dict(re.findall(r"--([\w-]+): (#\w{6});", light[1] if light else ""))


@cache
def _style_sheets() -> str:
    return str(read_style_sheets())
