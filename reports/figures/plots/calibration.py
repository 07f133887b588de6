"""Calibration: how often truths fall into predicted intervals, against how often they should."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from seaborn import objects

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.figures.plots.base import NothingToDrawError, Plot
from mocapbench.reports.figures.plots.choice import choose_labels, count_models
from mocapbench.reports.figures.plots.look import Styles, scale_mark, scales_of
from mocapbench.reports.figures.scores.reliability import coverage_curves

__all__ = ["Calibration"]


class Calibration(Plot):
    """A curve for each model that predicts variances, beside the diagonal of a calibrated one."""

    def tabulate(
        self, bundle: Bundle, results: TaskResults, metrics: Sequence[str]
    ) -> Mapping[str, pd.DataFrame]:
        """Return a row for each model and nominal level."""
        del bundle, metrics
        curves = coverage_curves(results)
        if not curves:
            raise NothingToDrawError("no model has the coverage of intervals at two levels or more")
        rows = [
            (results.layout.name, "", label, nominal, share)
            for label in choose_labels(results, results.layout.page.metrics[0], curves)
            for nominal, share in curves[label].items()
        ]
        columns = ["task", "panel", "label", "nominal", "coverage"]
        return {"": count_models(pd.DataFrame(rows, columns=columns), len(curves))}

    def draw(self, axes: Axes, panel: pd.DataFrame, styles: Styles) -> None:
        """Draw the diagonal and the curves on equal axes."""
        low = float(np.floor(10.0 * panel[["nominal", "coverage"]].min().min()) / 10.0)
        axes.plot([low, 1.0], [low, 1.0], ":", color="#57606a", linewidth=0.8)
        plot = (
            objects.Plot(panel, x="nominal", y="coverage", color="label", marker="label")
            .add(
                objects.Line(linewidth=scale_mark(1.2), pointsize=scale_mark(3.5)),
                linestyle="label",
                legend=False,
            )
            .scale(**scales_of(panel["label"], styles))
        )
        plot.theme({}).on(axes).plot()
        room = (low, 1.01)
        axes.set(xlim=room, ylim=room, xlabel="nominal coverage", ylabel="empirical coverage")

    def height(self, panel: pd.DataFrame, width: float) -> float:
        """Return the width, so that both axes are as long."""
        del panel
        return 0.95 * width

    def describe(self, table: pd.DataFrame) -> str:
        """Return what the axes are."""
        del table
        return (
            "Share of hidden values within predicted intervals against the nominal share; on the "
            "dotted line both are the same."
        )

    def keys(self, table: pd.DataFrame) -> Sequence[str]:
        """Return the models."""
        return [*dict.fromkeys(table["label"])]
