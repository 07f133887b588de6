"""Error along the gap, over the gaps of all windows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from seaborn import objects

from mocapbench.basics.arrays import Array
from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.figures.plots.base import NothingToDrawError, Plot
from mocapbench.reports.figures.plots.look import Styles, scale_mark, scales_of
from mocapbench.reports.figures.scores.best import best_labels
from mocapbench.reports.figures.scores.gap_error import N_BEST, errors_along_gaps

__all__ = ["AlongGap"]

_COLUMNS = (
    *("task", "metric", "quantity", "panel", "label"),
    *("position", "mean", "low", "high", "n"),
)


class AlongGap(Plot):
    """A curve for each of the best models; shaded areas hold the middle half of the gaps."""

    def tabulate(
        self, bundle: Bundle, results: TaskResults, metrics: Sequence[str]
    ) -> Mapping[str, pd.DataFrame]:
        """Return a row for each point of a curve, of the metric whose course records have."""
        del metrics
        found = errors_along_gaps(results, bundle.parts)
        if not found:
            raise NothingToDrawError(
                "no record has errors by frame of gaps of eight frames or more"
            )
        metric = bundle.parts.metrics[results.layout.name]
        about = (results.layout.name, metric, results.metrics[metric].quantity, "")
        rows = [
            (*about, label, position, *numbers, len(found[label]))
            for label in best_labels(results, metric, found, N_BEST)
            for position, numbers in _course(found[label])
        ]
        if not rows:
            raise NothingToDrawError("no model has a score in every case")
        return {metric: pd.DataFrame(rows, columns=list(_COLUMNS))}

    def draw(self, axes: Axes, panel: pd.DataFrame, styles: Styles) -> None:
        """Draw the curves of all models, and the areas of the first and the last."""
        looks = scales_of(panel["label"], styles)
        ends = panel[panel["label"].isin([panel["label"].iloc[0], panel["label"].iloc[-1]])]
        plot = (
            objects.Plot(panel, x="position", y="mean", color="label")
            .add(
                objects.Band(alpha=0.15, edgewidth=0.0),
                data=ends,
                ymin="low",
                ymax="high",
                legend=False,
            )
            .add(objects.Line(linewidth=scale_mark(1.2)), linestyle="label", legend=False)
            .scale(color=looks["color"], linestyle=looks["linestyle"])
        )
        plot.theme({}).on(axes).plot()
        axes.set(xlim=(0.0, 1.0), xlabel="position in the gap", ylabel=panel["quantity"].iloc[0])
        axes.set_ylim(bottom=0.0)

    def height(self, panel: pd.DataFrame, width: float) -> float:
        """Return a height in proportion to the width."""
        del panel
        return 0.62 * width

    def describe(self, table: pd.DataFrame) -> str:
        """Return what the curves are over, and what is shaded."""
        gaps = format_count(int(table["n"].max()), "gap")
        names = " and ".join(dict.fromkeys([table["label"].iloc[0], table["label"].iloc[-1]]))
        return (
            f"Means over {gaps}, each stretched to one length, from the first hidden frame (0) to "
            f"the last (1), of the best models and the best interpolation. Shaded areas hold the "
            f"middle half of the gaps, of {names}."
        )

    def keys(self, table: pd.DataFrame) -> Sequence[str]:
        """Return the models."""
        return [*dict.fromkeys(table["label"])]


def _course(errors: Array) -> list[tuple[float, tuple[float, float, float]]]:
    """Return the mean and the quartiles at each position of errors (W, P) along gaps."""
    positions = (np.arange(errors.shape[1]) + 0.5) / errors.shape[1]
    numbers = np.array([errors.mean(axis=0), *np.quantile(errors, [0.25, 0.75], axis=0)])
    return [(at, (m, low, high)) for at, (m, low, high) in zip(positions, numbers.T, strict=True)]
