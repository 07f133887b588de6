"""How the report presents a task: text, names in the papers, and pictures.

Nothing on a page changes a result, so that rewording one recomputes nothing.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

from mocapbench.reports.bundle.pictures import Picture

__all__ = ["Figure", "RowNotes", "TaskPage"]


@dataclass(frozen=True, kw_only=True)
class RowNotes:
    """What the tables say of one case beside its numbers.

    Parameters
    ----------
    published : str or None
        The row's name in the published values, None where the paper has no such row.
    remark : str
        Shown in the row.
    not_comparable : mapping of str to str
        By label, why the row's published values cannot be set beside ours.
    """

    published: str | None = None
    remark: str = ""
    not_comparable: Mapping[str, str] = field(default_factory=dict)


class Figure(Protocol):
    """A kind of picture that a page declares."""

    def pictures(self, solved: Any, /) -> Sequence[Picture]:
        """Return the pictures of a solved problem, which this package knows nothing of."""


@dataclass(frozen=True, kw_only=True)
class TaskPage:
    """How the report presents a task."""

    title: str
    reference: str
    description: str
    metrics: tuple[str, ...]
    kind: str = "impute"
    rows: Mapping[str, RowNotes] = field(default_factory=dict)
    published_models: Mapping[str, str] = field(default_factory=dict)
    published_metrics: Mapping[str, str] = field(default_factory=dict)
    not_comparable: Mapping[tuple[str, str], str] = field(default_factory=dict)
    exempt: Mapping[str, str] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()
    crossed: tuple[str, str] | None = None
    illustrated: tuple[str, ...] = ()
    figures: tuple[Figure, ...] = ()

    def notes(self, case: str) -> RowNotes:
        """Return the notes on ``case``, empty ones where there are none."""
        return self.rows.get(case, RowNotes())
