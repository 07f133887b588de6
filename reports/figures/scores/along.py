"""Scores as curves along a column of numbers, such as the length of a gap."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from markupsafe import Markup

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import standings
from mocapbench.reports.analysis.units import FoldSample
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.figures.axes import LEFT, TOP, WIDTH, draw_axes, panels
from mocapbench.reports.figures.intervals import centre, interval
from mocapbench.reports.figures.marks import band, dot, group, polyline
from mocapbench.reports.figures.scale import Scale, fit_count_scale, fit_scale, remark
from mocapbench.reports.figures.scores.fold_values import FoldValues, fold_values
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import SvgFigure, line_keys

__all__ = ["N_BANDS", "curves_along", "group_cases"]

Curve = Mapping[float, FoldSample]
"""By place along the column, in ascending order."""

HEIGHT, N_BANDS = 220.0, 3
FEWEST_BANDED = 3
"""Of two units an interval is 13 times as wide as they are apart: it would hide the curves."""
CAPTION = (
    "intervals are of the {n} models with the least mean, where there are {units} units or more."
)
DASHED = "Grey and dashed: the best interpolation, {label}."


def curves_along(
    results: TaskResults, metric: str, column: str, styles: Mapping[str, DrawingStyle]
) -> SvgFigure | None:
    """Return the means over folds of each entrant as a curve along a column of the cases.

    Parameters
    ----------
    results : TaskResults
    metric : str
    column : str
        A column of the cases that holds numbers. Cases that are alike in all other columns share
        a panel.
    styles : mapping of str to DrawingStyle

    Returns
    -------
    SvgFigure or None
        None where no panel has two numbers with scores.
    """
    values = fold_values(results, metric)
    groups = group_cases(results, metric, column)
    if not groups:
        return None
    shown, dashed = _choose_curves(results, metric, {label for _, label in values}, styles)
    drawn = [
        _Panel(results, metric, column, values).draw(heading, cases, shown)
        for heading, cases in groups.items()
    ]
    notes = dict.fromkeys(note for _, note in drawn if note)
    caption = " ".join([CAPTION.format(n=N_BANDS, units=FEWEST_BANDED), *dashed, *notes])
    legend = line_keys(shown)
    title = f"{results.metrics[metric].title} along {column}"
    return SvgFigure(title, panels(panel for panel, _ in drawn), legend, caption)


def group_cases(
    results: TaskResults, metric: str, column: str
) -> Mapping[str, Sequence[CaseLayout]]:
    """Return the cases with scores that are alike in all columns but one, two or more, by these."""
    scored = {case for case, _, name in results.estimates if name == metric}
    alike = defaultdict(list)
    for case in results.cases:
        if case.name in scored:
            alike[_heading(case, column)].append(case)
    return {heading: cases for heading, cases in alike.items() if len(cases) > 1}


def _choose_curves(
    results: TaskResults, metric: str, scored: Container[str], styles: Mapping[str, DrawingStyle]
) -> tuple[dict[str, DrawingStyle], list[str]]:
    """Return the styles of the labels to draw, and what is said of those that are left out.

    Of interpolations beside other models the best alone is drawn, as a line to compare with.
    """
    labels = [label for label in results.layout.labels if label in scored]
    others = [label for label in labels if label not in results.layout.interpolations]
    ranked = [one.label for one in standings(results, metric) if one.label not in others]
    if not (others and ranked):
        return {label: styles[label] for label in labels}, []
    dashed = {ranked[0]: replace(styles[ranked[0]], hue="hr", shape=1)}
    shown = {label: styles[label] for label in others}
    return shown | dashed, [DASHED.format(label=ranked[0])]


class _Panel:
    """One set of axes: the cases that are alike in all columns but one."""

    def __init__(self, results: TaskResults, metric: str, column: str, values: FoldValues) -> None:
        self.results, self.metric, self.column, self.values = results, metric, column, values

    def draw(
        self, heading: str, cases: Sequence[CaseLayout], styles: Mapping[str, DrawingStyle]
    ) -> tuple[Markup, str]:
        """Return the panel, and a remark on its axis."""
        curves = self._curves(cases, styles)
        samples = (sample for curve in curves.values() for sample in curve.values())
        y = fit_scale((value for sample in samples for value in sample.values), 0, 1)
        y = type(y)(y.low, y.high, TOP + HEIGHT, TOP)
        along = [float(case.columns[self.column]) for case in cases]
        x = (fit_scale if min(along) else fit_count_scale)(along, LEFT, WIDTH)
        title = self.results.metrics[self.metric].title
        order = sorted(curves, key=lambda label: self._mean_loss(curves[label]))
        banded = [
            label for label in order[:N_BANDS] if any(map(_is_banded, curves[label].values()))
        ]
        marks = [
            *(group(styles[label], _band(curves[label], x, y)) for label in banded),
            *(group(styles[n], _curve(curves[n], x, y, styles[n]), title=n) for n in curves),
        ]
        notes = " ".join(filter(None, (y.about_means, remark(y))))
        label = f"{title} along {self.column}: {heading}"
        return draw_axes((x, y), heading, (self.column, title), marks, label), notes

    def _curves(self, cases: Sequence[CaseLayout], labels: Iterable[str]) -> Mapping[str, Curve]:
        """Return the values by label and place along the column, in ascending order."""
        ordered = sorted(cases, key=lambda case: float(case.columns[self.column]))
        curves: dict[str, dict[float, FoldSample]] = defaultdict(dict)
        for label in labels:
            for case in ordered:
                if (case.name, label) in self.values:
                    place = float(case.columns[self.column])
                    curves[label][place] = self.values[case.name, label]
        return curves

    def _mean_loss(self, curve: Curve) -> float:
        loss = self.results.metrics[self.metric].loss
        return float(np.mean([loss(float(np.mean(sample.values))) for sample in curve.values()]))


def _is_banded(sample: FoldSample) -> bool:
    return sample.n_units >= FEWEST_BANDED


def _curve(curve: Curve, x: Scale, y: Scale, style: DrawingStyle) -> str:
    places = x.places(np.array(list(curve)))
    heights = y.places(np.array([centre(sample, y) for sample in curve.values()]))
    dots = (dot(*point, style.shape) for point in zip(places, heights, strict=True))
    return "".join([polyline(places, heights), *dots])


def _band(curve: Curve, x: Scale, y: Scale) -> str:
    """Return the intervals, cut where the axis ends; of too few units there are none."""
    ends = [
        (interval(sample, y) if _is_banded(sample) else None) or (np.nan, np.nan)
        for sample in curve.values()
    ]
    low, high = (y.places(np.clip(side, y.low, y.high)) for side in np.array(ends).T)
    return band(x.places(np.array(list(curve))), low, high)


def _heading(case: CaseLayout, column: str) -> str:
    """Return what the case says in all columns but one."""
    others = [
        f"{name}: {value}".removesuffix(".0")
        for name, value in case.columns.items()
        if name != column
    ]
    return ", ".join([*others, "synthetic"] if case.synthetic else others)
