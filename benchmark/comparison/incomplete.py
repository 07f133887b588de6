"""What a comparison says of a side that lost folds: how many, and that it is not compared."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mocapbench.benchmark.comparison.rows import Row

__all__ = ["incomplete_notes", "losses"]

WHY = (
    "Incomplete: a job failed, has no result or no finite score. Nothing is tested there, as the "
    "folds in which a model succeeded may be the easy ones; means are over what both have."
)


def losses(row: Row, sides: tuple[str, str]) -> Iterator[tuple[str, str]]:
    """Yield each side that lost folds, and how many: ``"incomplete: 8 of 24 folds lost"``."""
    for side, lost in zip(sides, (row.first_lost, row.second_lost), strict=True):
        if lost:
            yield side, f"incomplete: {lost} of {row.folds} folds lost"


def incomplete_notes(rows: Sequence[Row], sides: tuple[str, str]) -> list[str]:
    """Return a line for each side of an entrant that lost folds of a task, and why it matters."""
    widest: dict[tuple[str, str, str], Row] = {}
    for row in sorted((row for row in rows if row.incomplete), key=lambda row: row.folds):
        widest[row.task, row.metric, row.entrant] = row
    lines = dict.fromkeys(
        f"{side} is {loss} ({', '.join(filter(None, (row.task, row.entrant)))})."
        for row in widest.values()
        for side, loss in losses(row, sides)
    )
    return [*lines, *([WHY] if lines else [])]
