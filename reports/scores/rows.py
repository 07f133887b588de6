"""The rows of a table of scores that are of this run: competitors, then references."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mocapbench.reports.analysis.case_means import case_means
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import Standing, standings
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.scores.behind import behind_cell, mean_cell
from mocapbench.reports.scores.cells import score_cell
from mocapbench.reports.scores.drawing import Drawing
from mocapbench.reports.scores.table import NO_SCORE, ScoreCell, ScoreRow
from mocapbench.reports.text import cell_anchor

__all__ = ["Rows"]


@dataclass(frozen=True, eq=False)
class Rows:
    """The rows of one table, best first.

    Parameters
    ----------
    results : TaskResults
    metric : str
    counting, shown : tuple of CaseLayout
        The cases that enter means, and those that have columns.
    places : int
        Decimals.
    drawing : Drawing
    """

    results: TaskResults
    metric: str
    counting: tuple[CaseLayout, ...]
    shown: tuple[CaseLayout, ...]
    places: int
    drawing: Drawing

    def __iter__(self) -> Iterator[ScoreRow]:
        """Return the rows of labels with a score, or with a job that gave none."""
        layout = self.results.layout
        competing = set(layout.ranked)
        others = [label for label in layout.labels if label not in self._ranked]
        others.sort(key=lambda label: label not in competing)
        rows = (self._row(label, label in competing) for label in [*self._ranked, *others])
        return (row for row in rows if any(c is not NO_SCORE for c in (row.mean, *row.cells)))

    @cached_property
    def _ranked(self) -> dict[str, Standing]:
        return {standing.label: standing for standing in standings(self.results, self.metric)}

    @cached_property
    def _best(self) -> dict[str, str | None]:
        return {case.name: self.results.best_label(case.name, self.metric) for case in self._cases}

    @property
    def _cases(self) -> tuple[CaseLayout, ...]:
        return self.shown or self.results.cases

    def _row(self, label: str, competes: bool) -> ScoreRow:
        standing = self._ranked.get(label)
        return ScoreRow(
            label,
            "ranked" if competes else "reference",
            self._mean(label, standing),
            behind_cell(standing, self.places),
            self.drawing.strip(label),
            tuple(self._cell(case, label) for case in self.shown),
            self.results.layout.model(label).family,
        )

    def _cell(self, case: CaseLayout, label: str) -> ScoreCell:
        best = self._best[case.name] == label
        return score_cell(self.results, case, label, self.metric, self.places, best=best)

    def _mean(self, label: str, standing: Standing | None) -> ScoreCell:
        """Return the mean over the cases that count; with one case, what is behind it."""
        if len(self.results.cases) == 1:
            return self._cell(self.results.cases[0], label)
        means = case_means(self.results, self.metric, label)
        if not means:
            return NO_SCORE
        mean = float(np.mean(means)) if standing is None else standing.mean
        link = cell_anchor(self.results.layout.name, "", label)
        n_cases = len(self.counting)
        lacking = "" if len(means) == n_cases else f"{len(means)} of {n_cases} cases"
        return mean_cell(mean, standing, self.places, lacking, link)
