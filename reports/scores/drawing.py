"""The drawings in the rows of a table of scores, on one scale."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Self

import numpy as np
from markupsafe import Markup

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.figures.intervals import interval
from mocapbench.reports.figures.scale import Scale
from mocapbench.reports.figures.strip import strip, strip_axis, strip_scale
from mocapbench.reports.figures.styles import Style
from mocapbench.reports.text import counted

__all__ = ["Drawing"]


@dataclass(frozen=True, eq=False)
class Drawing:
    """The strips of a table.

    Parameters
    ----------
    values : mapping of str to sequence of float
        By label, the values of the cases that enter means, one a fold.
    scale : Scale or None
        None where no label has a value.
    styles : mapping of str to Style
    independent : bool
        Whether folds are independent draws, of which there is an interval.
    """

    values: Mapping[str, Sequence[float]]
    scale: Scale | None
    styles: Mapping[str, Style]
    independent: bool

    @classmethod
    def of(
        cls,
        results: TaskResults,
        metric: str,
        cases: Sequence[CaseLayout],
        styles: Mapping[str, Style],
    ) -> Self:
        """Return the drawing of the scores of ``metric`` in ``cases``."""
        grid, names = results.grid, [case.name for case in cases]
        chosen = grid.select(metric, grid.labels, [name for name in names if name in grid.cases])
        flat = {
            label: row[np.isfinite(row)].tolist()
            for label, row in zip(grid.labels, chosen, strict=True)
        }
        values = {label: row for label, row in flat.items() if row}
        scale = strip_scale(chain.from_iterable(values.values())) if values else None
        return cls(values, scale, styles, results.layout.independent_folds)

    @property
    def axis(self) -> Markup | None:
        """The axis that all strips share."""
        return strip_axis(self.scale, "axis of the drawings below") if self.scale else None

    def strip(self, label: str) -> Markup | None:
        """Return the strip of ``label``; None where it has no value."""
        if self.scale is None or label not in self.values:
            return None
        values = self.values[label]
        ends = interval(values, self.scale) if self.independent else None
        name = f"{label}, {counted(len(values), 'value')}"
        return strip(values, ends, self.scale, name, self.styles[label])
