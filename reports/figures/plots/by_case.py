"""Each metric case by case with error bars, beside the published values, as the thesis draws them.

After J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017, Figures 17–24.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import ClassVar

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from seaborn import objects

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.figures.plots.base import NothingToDrawError, Plot
from mocapbench.reports.figures.plots.choice import choose_labels, choose_metrics, count_models
from mocapbench.reports.figures.plots.look import Styles, fit_axis, scale_mark, scales_of, wrap_text
from mocapbench.reports.figures.styles import DrawingStyle

__all__ = ["ByCase"]

MOST_CASES = 24
MOST_LETTERS = 40
"""Of names of cases side by side; more stand upright."""
_COLUMNS = (
    *("task", "metric", "quantity", "panel", "case"),
    *("label", "published", "mean", "low", "high", "n"),
)


class ByCase(Plot):
    """A panel for each metric of the page, cases from left to right, a marker for each model."""

    narrowest: ClassVar[float] = 36.0

    def tabulate(
        self, bundle: Bundle, results: TaskResults, metrics: Sequence[str]
    ) -> Mapping[str, pd.DataFrame]:
        """Return a row for each model in each case, and for each published value beside it."""
        del bundle
        if len(results.cases) > MOST_CASES:
            raise NothingToDrawError(f"it has more than {MOST_CASES} cases")
        shown = choose_metrics(results, metrics or results.layout.page.metrics)
        scored = {label for _, label, _ in results.estimates}
        labels = choose_labels(results, shown[0], scored) if shown else []
        rows = [row for metric in shown for row in _list_rows(results, metric, labels)]
        if not rows:
            raise NothingToDrawError("no model has a score")
        return {"": count_models(pd.DataFrame(rows, columns=list(_COLUMNS)), len(scored))}

    def draw(self, axes: Axes, panel: pd.DataFrame, styles: Styles) -> None:
        """Draw markers and intervals, those of a case beside each other."""
        looks = scales_of(panel["label"], styles)
        plot = (
            objects.Plot(panel, x="case", y="mean", color="label", marker="label")
            .add(
                objects.Range(linewidth=scale_mark(0.9)),
                objects.Dodge(),
                ymin="low",
                ymax="high",
                legend=False,
            )
            .add(objects.Dot(pointsize=scale_mark(3.5)), objects.Dodge(), legend=False)
            .scale(color=looks["color"], marker=looks["marker"])
        )
        plot.theme({}).on(axes).plot()
        fit_axis(axes, "y", panel["mean"], [*panel["low"], *panel["high"]])
        axes.tick_params("x", rotation=90 if _stand_upright(panel) else 0)
        place = axes.get_subplotspec()
        axes.tick_params("x", labelbottom=place is None or place.is_last_row())
        axes.set(xlabel="", ylabel="", title=wrap_text(panel["panel"].iloc[0]))

    def height(self, panel: pd.DataFrame, width: float) -> float:
        """Return the height of a low panel."""
        del panel
        return 0.4 * width

    def foot(self, table: pd.DataFrame) -> float:
        """Return room for names of cases that stand upright."""
        return 0.55 * max(map(len, table["case"])) if _stand_upright(table) else 0.0

    def describe(self, table: pd.DataFrame) -> str:
        """Return what markers and bars are."""
        grey = (
            " Grey: published values, with their ± where printed."
            if table["published"].any()
            else ""
        )
        return (
            "Markers are means over folds, bars their 95 % intervals by Student’s t where folds "
            f"give one, cut where the axis ends.{grey}"
        )

    def add_styles(self, table: pd.DataFrame, styles: Styles) -> Styles:
        """Return the styles of models, and grey ones of the papers' models."""
        names = dict.fromkeys(table["label"][table["published"]])
        grey = {name: DrawingStyle("hr", 3 + n % 3, name) for n, name in enumerate(names)}
        return {**styles, **grey}

    def keys(self, table: pd.DataFrame) -> Sequence[str]:
        """Return the models, ours and those of the papers."""
        return [*dict.fromkeys(table["label"])]


def _stand_upright(table: pd.DataFrame) -> bool:
    """Return whether the names of cases are too long to lie side by side."""
    return sum(map(len, {*table["case"]})) > MOST_LETTERS


def _list_rows(
    results: TaskResults, metric: str, labels: Sequence[str]
) -> Iterator[tuple[object, ...]]:
    """Yield the rows of ours, and of what the papers have beside them."""
    quantity = results.metrics[metric].quantity
    about = (results.layout.name, metric, quantity, quantity)
    for case in results.cases:
        theirs = {}
        for label in labels:
            if (ours := results.estimate(case.name, label, metric)) is not None:
                yield *about, case.name, label, False, *_ends(ours.mean, ours.half_width), ours.n
            if (published := results.published_value(case, label, metric)) is not None:
                theirs[f"{published.model} (published)"] = _ends(published.value, published.two_sd)
        yield from ((*about, case.name, name, True, *ends, np.nan) for name, ends in theirs.items())


def _ends(mean: float, half: float | None) -> tuple[float, float, float]:
    reach = np.nan if half is None else half
    return mean, mean - reach, mean + reach
