"""The strips of a table of scores: the values of each label, all on one scale."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import chain

import numpy as np
from markupsafe import Markup

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.units import FoldSample, unit_names
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.figures.strip import strip, strip_axis, strip_scale
from mocapbench.reports.figures.styles import DrawingStyle

__all__ = ["draw_strips"]


def draw_strips(
    results: TaskResults,
    metric: str,
    cases: Sequence[CaseLayout],
    styles: Mapping[str, DrawingStyle],
) -> tuple[Mapping[str, Markup], Markup | None]:
    """Return the strip of each label that has scores in ``cases``, and their axis; None of none."""
    samples = _samples(results, metric, cases)
    if not samples:
        return {}, None
    scale = strip_scale(chain.from_iterable(sample.values for sample in samples.values()))
    strips = {
        label: strip(
            sample, scale, f"{label}, {format_count(len(sample.values), 'value')}", styles[label]
        )
        for label, sample in samples.items()
    }
    return strips, strip_axis(scale, "axis of the drawings below")


def _samples(
    results: TaskResults, metric: str, cases: Sequence[CaseLayout]
) -> Mapping[str, FoldSample]:
    folds, independent = results.fold_numbers, results.layout.independent_folds
    labels, names = results.layout.labels, [case.name for case in cases]
    rows = results.values(metric, labels, names)
    units = np.array(
        [u for case in cases for u in unit_names(case, folds, independent=independent)]
    )
    of_cells = np.repeat(names, len(folds))
    return {
        label: FoldSample.of(row[kept].tolist(), units[kept], of_cells[kept])
        for label, row in zip(labels, map(np.ravel, rows), strict=True)
        if (kept := np.isfinite(row)).any()
    }
