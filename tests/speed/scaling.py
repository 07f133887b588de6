"""Seconds and peak memory as a problem grows: `python scaling.py SAVED FIGURE`.

From the size of three walks one axis at a time is moved. Every point is a process of its own; a
way leaves an axis where a point takes too long or too much memory. The points are saved as JSON;
a file of them that exists is drawn without measuring anew. Prints the exponents of the growth.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pandas as pd
import seaborn as sns
from page import table
from problems import SIZES, Size
from ways import measured

WAYS = ("dense", "latent-split", "state-space", "auto")
AXES = {
    "N": ("n_times", (90, 180, 300, 600, 1000, 2000, 3000)),
    "R": ("n_replicates", (2, 3, 10, 30, 100)),
    "D": ("n_outputs", (3, 6, 12, 24, 39, 62)),
    "Q": ("n_components", (1, 2, 3, 5, 9)),
    "rank": ("rank", (1, 3, 9)),
}
START = SIZES["mocap Q1"]
VISIBLE = START.n_visible / START.n_times
MOST_SECONDS, MOST_GB = 5.0, 8.0
N_LARGEST = 3
"""Points that an exponent is fitted to: at the small ones overheads rule."""


def sizes(axis: str) -> Iterator[tuple[int, Size]]:
    """Yield the values of an axis and the problems there, a fixed share of frames visible."""
    field, values = AXES[axis]
    for value in values:
        size = replace(START, **{field: value})
        yield value, replace(size, n_visible=round(VISIBLE * size.n_times))


def measure() -> Iterator[dict[str, Any]]:
    """Yield the points one by one."""
    for axis in AXES:
        for how in WAYS:
            for value, size in sizes(axis):
                try:
                    figures = measured(size, how, most_gb=MOST_GB, timeout=3 * MOST_SECONDS)
                except subprocess.SubprocessError:
                    break
                yield {"axis": axis, "way": how, "value": value, **figures}
                if figures["seconds"] > MOST_SECONDS:
                    break


def summary(points: pd.DataFrame) -> str:
    """Return a table with a line for each axis and way."""
    rows = []
    for (axis, how), line in points.groupby(["axis", "way"], sort=False):
        first, last = line.iloc[0], line.iloc[-1]
        cells = [axis, how, f"{first.value:.0f} … {last.value:.0f}"]
        for what in ("seconds", "own_mb"):
            cells.append(f"{first[what]:.2g} … {last[what]:.2g}")
            cells.append(exponent(line.value, line[what]))
        rows.append(cells)
    return table(("axis", "way", "from … to", "seconds", "exponent", "MB", "exponent"), rows)


def exponent(x: pd.Series, y: pd.Series) -> str:
    """Return the slope of log y over log x at the largest x, of what can be measured."""
    line = pd.DataFrame({"x": x, "y": y})[y > 0].tail(N_LARGEST)
    if len(line) < 2:
        return "–"
    return f"{np.polyfit(np.log(line.x), np.log(line.y), 1)[0]:.1f}"


def draw(points: pd.DataFrame, path: Path) -> None:
    """Draw every axis, seconds above memory."""
    mpl.rcParams |= {"svg.fonttype": "none", "svg.hashsalt": "scaling"}
    long = points.rename(columns={"own_mb": "MB"}).melt(
        ["axis", "way", "value"], ["seconds", "MB"], "what", "figure"
    )
    grid = sns.relplot(
        long,
        x="value",
        y="figure",
        row="what",
        col="axis",
        hue="way",
        style="way",
        kind="line",
        markers=True,
        dashes=False,
        height=2.4,
        aspect=0.9,
        facet_kws={"sharex": "col", "sharey": "row", "margin_titles": True},
    )
    grid.set(xscale="log", yscale="log")
    grid.set_titles(row_template="", col_template="")
    for (row, column), ax in zip(np.ndindex(grid.axes.shape), grid.axes.flat, strict=True):
        name = grid.col_names[column]
        ticks = AXES[name][1][::2]
        ax.set_xticks(ticks, map(str, ticks))
        ax.set_xticks([], minor=True)
        ax.set(xlabel=name, ylabel=grid.row_names[row])
        ax.label_outer()
    grid.savefig(path, metadata={"Date": None})


def main(saved: str, figure: str) -> None:
    """Measure, or draw what is saved."""
    path = Path(saved)
    if not path.exists():
        path.write_text(json.dumps(list(measure())), encoding="utf-8")
    points = pd.DataFrame(json.loads(path.read_text(encoding="utf-8")))
    print(summary(points))
    draw(points, Path(figure))


if __name__ == "__main__":
    main(*sys.argv[1:])
