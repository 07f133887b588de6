"""The address of a job, by which seeds, jobs, records, the gate and comparisons know it."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["Address"]


class Address(NamedTuple):
    """Which entrant on which problem.

    Parameters
    ----------
    task, version, case : str, int, str
        The row of a task's table.
    fold : int or None
        Counted from 0; None speaks of all folds.
    label : str
        The entrant; empty where something speaks of all entrants.
    """

    task: str
    version: int
    case: str
    fold: int | None = None
    label: str = ""

    @property
    def all_folds(self) -> Address:
        """The same entrant and case, of all folds."""
        return self._replace(fold=None)

    def __str__(self) -> str:
        fold = () if self.fold is None else (f"fold {self.fold + 1}",)
        return " · ".join((self.task, self.case, self.label, *fold))
