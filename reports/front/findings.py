"""What one task says: the best model, its mean, the next, and the margin."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from mocapbench.basics.words import join_names
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import MOST_LEVEL, Place, Standing, level_with_best
from mocapbench.reports.front.board_cells import (
    board_cells,
    first_metric,
    is_generated,
    reference_of,
)
from mocapbench.reports.text import apart, number, slug

__all__ = ["RankedTask", "TaskFinding"]


@dataclass(frozen=True)
class TaskFinding:
    """What one task says.

    Parameters
    ----------
    id, title : str
        The anchor of the task's section, and its short title.
    text : str
        The best model, its mean, the next, and the margin.
    """

    id: str
    title: str
    text: str


@dataclass(frozen=True, eq=False)
class RankedTask:
    """A task with the standings by its first metric.

    Parameters
    ----------
    results : TaskResults
    ranked : sequence of Standing
        Best first, one or more.
    """

    results: TaskResults
    ranked: Sequence[Standing]

    @property
    def best(self) -> Standing:
        """The model of the best mean."""
        return self.ranked[0]

    @cached_property
    def level(self) -> list[Standing]:
        """The others whose mean is that of the best one."""
        return level_with_best(self.ranked)

    @property
    def lead(self) -> Place | None:
        """What the test says of the lead; None without a rival."""
        return self._next.standing if self._next else None

    @property
    def beaten(self) -> bool:
        """Whether the best model is no better than the task's reference."""
        return board_cells(self.results)[self.best.label].beaten

    @property
    def finding(self) -> TaskFinding:
        """What the task says."""
        title = self.results.layout.page.short
        title += " (synthetic)" if is_generated(self.results) else ""
        reference = f"; no better than {reference_of(self.results)}" if self.beaten else ""
        return TaskFinding(slug("task", self.results.layout.name), title, self._means + reference)

    @property
    def _means(self) -> str:
        names = join_names([one.label for one in [self.best, *self.level]], MOST_LEVEL)
        alike, second = ", alike:" if self.level else "", self._next
        places = self.results.decimals[first_metric(self.results)]
        if second is None:
            return f"{names}{alike} {number(self.best.mean, places)}"
        places = apart(self.best.mean, second.mean, places)
        mean, following = number(self.best.mean, places), number(second.mean, places)
        return f"{names}{alike} {mean}, next {second.label} {following}{_margin(second, places)}"

    @cached_property
    def _next(self) -> Standing | None:
        """The best of those that have every score and another mean than the first."""
        others = (one for one in self.ranked[1:] if one.complete and one not in self.level)
        return next(others, None)


def _margin(second: Standing, places: int) -> str:
    if math.isnan(second.low):
        return ""
    return f" (behind by {number(second.low, places)} to {number(second.high, places)})"
