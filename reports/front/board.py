"""The scoreboard as values: models × tasks, shaded by distance from the best of each task."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby

__all__ = ["FAILED", "INCOMPLETE", "SHADES", "BoardCell", "BoardColumn", "BoardRow", "Scoreboard"]

SHADES = ((1.0, "best"), (1.1, "within 10 %"), (1.5, "within 50 %"), (3.0, "within 3×"))
"""How many times worse than the best a mean may be, and the name of that shade."""

INCOMPLETE = "incomplete"
"""In place of a shade: the mean is over other folds than that of the best, and not compared."""

FAILED = "failed"
"""In place of a shade: there is no mean, since the model failed."""


@dataclass(frozen=True)
class BoardColumn:
    """A task.

    Parameters
    ----------
    id, title, long_title : str
        The anchor of its section, its short title and its title.
    question : str
        The title of the question that it puts.
    metric, unit : str
        Its first metric, by which it is scored, and the acronym or unit of that.
    arrow : str
        Which values are better.
    basis, units : str
        How many cases its means are over, and whether all are of generated motion; how many
        independent units these are.
    """

    id: str
    title: str
    long_title: str
    question: str
    metric: str
    unit: str
    arrow: str
    basis: str
    units: str


@dataclass(frozen=True)
class BoardCell:
    """The mean of one model in one task.

    Parameters
    ----------
    text : str
    value : float
        NaN where there is none.
    shade : str
        The name of its distance from the best, `INCOMPLETE` or `FAILED`; empty for what does not
        compete.
    beaten : bool
        Whether it is no better than the task's reference.
    link : str
        The address on the page of what is behind it, empty where nothing is.
    note : str
        What it says beside the number, such as the cases or folds that it lacks.
    """

    text: str
    value: float
    shade: str = ""
    beaten: bool = False
    link: str = ""
    note: str = ""

    @property
    def style(self) -> str:
        """Its classes in the style sheet."""
        if self.shade in (INCOMPLETE, FAILED):
            return self.shade
        step = [name for _, name in SHADES].index(self.shade) if self._near else len(SHADES)
        return f"shade-{step}" + (" beaten" if self.beaten else "") if self.shade else "reference"

    @property
    def _near(self) -> bool:
        return self.shade in {name for _, name in SHADES}


@dataclass(frozen=True)
class BoardRow:
    """A model, or a reference. ``cells`` hold None where it took no part, or has no recording."""

    label: str
    cells: tuple[BoardCell | None, ...]


@dataclass(frozen=True)
class Scoreboard:
    """The table of the first screen.

    Parameters
    ----------
    columns : tuple of BoardColumn
        Tasks, by question.
    groups : tuple of (family, rows)
        The competitors.
    references : tuple of BoardRow
        Limits and simple fills, which are not shaded.
    """

    columns: tuple[BoardColumn, ...]
    groups: tuple[tuple[str, tuple[BoardRow, ...]], ...]
    references: tuple[BoardRow, ...]

    @property
    def questions(self) -> list[tuple[str, int]]:
        """The questions, each with the number of its columns."""
        runs = groupby(column.question for column in self.columns)
        return [(question, len(list(run))) for question, run in runs]

    @property
    def has_beaten(self) -> bool:
        """Whether a model is no better than the reference of a task."""
        return any(cell.beaten for cell in self._competing)

    @property
    def has_incomplete(self) -> bool:
        """Whether a model lacks folds that the best one of a task has."""
        return any(cell.shade == INCOMPLETE for cell in self._competing)

    @property
    def _competing(self) -> list[BoardCell]:
        rows = (row for _, rows in self.groups for row in rows)
        return [cell for row in rows for cell in row.cells if cell is not None]
