"""Heat maps of covariances: the truth where it is known, and what models found."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import ClassVar

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from numpy.typing import NDArray
from seaborn import heatmap

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.bundle.pictures import HeatMaps
from mocapbench.reports.figures.plots.base import NothingToDrawError, Plot
from mocapbench.reports.figures.plots.look import Styles, level_colours, wrap_text
from mocapbench.reports.text import slug

__all__ = ["Covariances"]

MOST_NAMES, _TITLE = 12, 13
_COLUMNS = (
    *("task", "panel", "row", "column"),
    *("row_name", "column_name", "value", "limit"),
)


class Covariances(Plot):
    """A panel for each matrix, all of a figure on one scale around zero."""

    narrowest: ClassVar[float] = 8.5
    shows_pictures: ClassVar[bool] = True

    def tabulate(
        self, bundle: Bundle, results: TaskResults, metrics: Sequence[str]
    ) -> Mapping[str, pd.DataFrame]:
        """Return a row for each entry of each matrix."""
        del metrics
        task = results.layout.name
        pictures = [p for p in bundle.illustrations if isinstance(p, HeatMaps) and p.task == task]
        tables = {slug(picture.title): _tabulate_maps(picture, results) for picture in pictures}
        if not tables:
            raise NothingToDrawError("the run keeps no covariance of it")
        return tables

    def draw(self, axes: Axes, panel: pd.DataFrame, styles: Styles) -> None:
        """Draw a matrix, its blocks named where neighbours share a name."""
        del styles
        colours = LinearSegmentedColormap.from_list("levels", level_colours())
        limit = float(panel["limit"].iloc[0])
        heatmap(
            panel.pivot(index="row", columns="column", values="value"),
            ax=axes,
            cmap=colours,
            vmin=-limit,
            vmax=limit,
            square=True,
            cbar=False,
            rasterized=True,
        )
        _name_blocks(axes, panel)
        title = wrap_text(panel["panel"].iloc[0], _TITLE)
        axes.set_title(title, fontsize="small", fontweight="normal")

    def add_key(self, figure: Figure, table: pd.DataFrame, styles: Styles) -> None:
        """Add the scale of the colours."""
        del styles
        drawn, limit = figure.axes[0].collections[0], float(table["limit"].iloc[0])
        ticks = [-limit, 0.0, limit]
        figure.colorbar(drawn, ax=figure.axes, shrink=0.6, pad=0.02, ticks=ticks, format="%.2g")

    def height(self, panel: pd.DataFrame, width: float) -> float:
        """Return the width, and room for a title."""
        del panel
        return width + 2.0

    def foot(self, table: pd.DataFrame) -> float:
        """Return room for the names below the last row of panels."""
        names, _ = _list_blocks(table)
        return 0.6 * max(map(len, names)) if names else 0.0

    def describe(self, table: pd.DataFrame) -> str:
        """Return the scale."""
        limit = float(table["limit"].iloc[0])
        return f"Colours run from −{limit:.3g} (blue) over zero to {limit:.3g} (orange)."


def _tabulate_maps(picture: HeatMaps, results: TaskResults) -> pd.DataFrame:
    """Return the entries of the matrices of labels that are shown, and of the truth."""
    others = {*results.layout.labels}
    names = np.array(picture.labels)
    rows, columns = np.indices((len(names), len(names))).reshape(2, -1)
    parts = [
        pd.DataFrame(
            {
                "task": picture.task,
                "panel": title,
                "row": rows,
                "column": columns,
                "row_name": names[rows],
                "column_name": names[columns],
                "value": matrix.ravel(),
                "limit": picture.limit,
            }
        )
        for title, matrix in picture.maps.items()
        if title in others or title not in results.layout.models
    ]
    return pd.concat(parts, ignore_index=True)[list(_COLUMNS)]


def _list_blocks(panel: pd.DataFrame) -> tuple[list[str], NDArray[np.intp]]:
    """Return the names of runs of rows of one name, none where these are many, and their ends."""
    rows = panel.drop_duplicates("row").sort_values("row")["row_name"]
    runs = [(str(name), len([*run])) for name, run in groupby(rows)]
    ends = np.cumsum([size for _, size in runs])
    return [name for name, _ in runs if len(runs) <= MOST_NAMES], ends


def _name_blocks(axes: Axes, panel: pd.DataFrame) -> None:
    """Name the blocks on the left and below, and draw lines between blocks of several rows."""
    names, ends = _list_blocks(panel)
    middles = (np.array([0, *ends[:-1]]) + ends)[: len(names)] / 2.0
    place = axes.get_subplotspec()
    axes.set_xticks(middles, names, rotation=90)
    axes.set_yticks(middles, names, rotation=0)
    if place is not None:
        axes.tick_params(labelbottom=place.is_last_row(), labelleft=place.is_first_col())
    axes.tick_params(length=0)
    axes.set(xlabel="", ylabel="")
    if len(ends) < min(panel["row"].nunique(), MOST_NAMES):
        for end in ends[:-1].tolist():
            axes.axhline(end, color="#57606a", linewidth=0.4)
            axes.axvline(end, color="#57606a", linewidth=0.4)
