"""The drawings in the rows of a table of scores, on one scale."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Self

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.fold_sample import FoldSample
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.units import unit_names
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.figures.scale import Scale
from mocapbench.reports.figures.strip import strip, strip_axis, strip_scale
from mocapbench.reports.figures.styles import DrawingStyle

__all__ = ["Drawing"]

Names = NDArray[np.str_]


@dataclass(frozen=True, eq=False)
class Drawing:
    """The strips of a table.

    Parameters
    ----------
    samples : mapping of str to FoldSample
        By label, of the cases that enter means.
    scale : Scale or None
        None where no label has a value.
    styles : mapping of str to DrawingStyle
    """

    samples: Mapping[str, FoldSample]
    scale: Scale | None
    styles: Mapping[str, DrawingStyle]

    @classmethod
    def of(
        cls,
        results: TaskResults,
        metric: str,
        cases: Sequence[CaseLayout],
        styles: Mapping[str, DrawingStyle],
    ) -> Self:
        """Return the drawing of the scores of ``metric`` in ``cases``."""
        grid = results.grid
        scored = [case for case in cases if case.name in grid.cases]
        chosen = grid.select(metric, grid.labels, [case.name for case in scored])
        rows = zip(grid.labels, map(np.ravel, chosen), strict=True)
        units, of_cells = _cells(results, scored)
        samples = {
            label: FoldSample.of(row[kept].tolist(), units[kept], of_cells[kept])
            for label, row in rows
            if (kept := np.isfinite(row)).any()
        }
        every = chain.from_iterable(sample.values for sample in samples.values())
        return cls(samples, strip_scale(every) if samples else None, styles)

    @property
    def axis(self) -> Markup | None:
        """The axis that all strips share."""
        return strip_axis(self.scale, "axis of the drawings below") if self.scale else None

    def strip(self, label: str) -> Markup | None:
        """Return the strip of ``label``; None where it has no value."""
        if self.scale is None or label not in self.samples:
            return None
        sample = self.samples[label]
        name = f"{label}, {format_count(len(sample.values), 'value')}"
        return strip(sample, self.scale, name, self.styles[label])


def _cells(results: TaskResults, cases: Sequence[CaseLayout]) -> tuple[Names, Names]:
    """Return the unit and the case of every fold of the cases."""
    folds, independent = results.grid.folds, results.layout.independent_folds
    units = [unit for case in cases for unit in unit_names(case, folds, independent=independent)]
    return np.array(units), np.repeat([case.name for case in cases], len(folds))
