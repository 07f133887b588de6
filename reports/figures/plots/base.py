"""What a kind of figure for papers is: a tidy table, and how one panel of it is drawn."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import ClassVar

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.figures.plots.look import Styles, add_legend

__all__ = ["NothingToDrawError", "Plot"]


class NothingToDrawError(ValueError):
    """A run lacks what a kind of figure shows; the message says what that is."""


class Plot(ABC):
    """A kind of figure.

    A table has a column ``panel``; its rows of one value are drawn in axes of their own.
    """

    narrowest: ClassVar[float] = 22.0
    """Least width of a panel, in em: where there is room for several, they stand side by side."""

    shows_pictures: ClassVar[bool] = False
    """Whether it draws pictures of the bundle, which are made from stored solutions."""

    @abstractmethod
    def tabulate(
        self, bundle: Bundle, results: TaskResults, metrics: Sequence[str]
    ) -> Mapping[str, pd.DataFrame]:
        """Return the tidy tables of a task, each by what tells its figure from the others.

        Parameters
        ----------
        bundle : Bundle
        results : TaskResults
            Of one task of it.
        metrics : sequence of str
            Those that are named; none for what the task's page shows.

        Raises
        ------
        NothingToDrawError
            If the run lacks what the figure shows.
        """

    @abstractmethod
    def draw(self, axes: Axes, panel: pd.DataFrame, styles: Styles) -> None:
        """Draw the rows of one panel."""

    @abstractmethod
    def height(self, panel: pd.DataFrame, width: float) -> float:
        """Return the height of a panel of a width, both in em."""

    @abstractmethod
    def describe(self, table: pd.DataFrame) -> str:
        """Return sentences for a caption, which say what marks and intervals are."""

    def add_styles(self, table: pd.DataFrame, styles: Styles) -> Styles:
        """Return the styles of all that a figure shows, which may be more than models."""
        del table
        return styles

    def add_key(self, figure: Figure, table: pd.DataFrame, styles: Styles) -> None:
        """Add what explains colours, by default a legend of the labels that `keys` names."""
        add_legend(figure, {label: styles[label] for label in self.keys(table)})

    def foot(self, table: pd.DataFrame) -> float:
        """Return the height of what stands below the last panel, in em; by default nothing."""
        del table
        return 0.0

    def keys(self, table: pd.DataFrame) -> Sequence[str]:
        """Return the labels that the legend names; by default none."""
        del table
        return ()
