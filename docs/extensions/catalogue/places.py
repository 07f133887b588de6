"""Where a model stands in each task, by the stored reference values."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from catalogue.reference import Stored, Today
from mocapbench.benchmark.inspection.work import alike, typical
from mocapbench.benchmark.tasks.address import Address
from mocapbench.reports.analysis.standings import Place as Lead
from mocapbench.reports.analysis.standings import Standing, standings
from mocapbench.reports.front.scoreboard import (
    SHADES,
    WORSE,
    BoardCell,
    board_cells,
    first_metric,
    reference_of,
)

__all__ = ["Place", "places", "two_digits"]

NEAR = SHADES[1][1]
FAR = {WORSE: f"beyond {SHADES[-1][0]:g}×"}


@dataclass(frozen=True)
class Place:
    """One entrant of a model in one task.

    Parameters
    ----------
    task, title, short, label, profile, metric : str
        Where the value is from; the metric is the task's first.
    mean : str
        Over the cases that count.
    rank : int or None
        Among ``n_ranked`` entrants, 1 for the best; None for a reference, which does not compete.
    n_ranked : int
    shade : str
        How far from the best: ``"best"``, ``"within 10 %"``, …; empty for a reference.
    finding : str
        Whether that is more than chance, where it is tested.
    beaten_by : str
        The task's reference, where the entrant is no better; else empty.
    seconds : float or None
        What a fit took, in a run of the developers.
    """

    task: str
    title: str
    short: str
    label: str
    profile: str
    metric: str
    mean: str
    rank: int | None
    n_ranked: int
    shade: str
    finding: str
    beaten_by: str
    seconds: float | None

    @property
    def order(self) -> float:
        """The share of entrants that are no worse, by which wins come first; references last."""
        return 2.0 if self.rank is None else self.rank / self.n_ranked

    @property
    def distance(self) -> str:
        """How far from the best, and whether that is more than chance."""
        return ", ".join(filter(None, (FAR.get(self.shade, self.shade), self.finding))) or "–"

    @property
    def seconds_text(self) -> str:
        """The seconds to two digits."""
        return "–" if self.seconds is None else two_digits(self.seconds)

    @property
    def near(self) -> bool:
        """Whether it is within 10 % of the best, and not the best."""
        return self.shade == NEAR

    @property
    def last(self) -> bool:
        """Whether nothing that competes is worse."""
        return self.rank == self.n_ranked > 1


def places(today: Today) -> dict[str, list[Place]]:
    """Return, for each model, a place for each of its entrants that has a score, task by task."""
    found: dict[str, list[Place]] = {}
    for stored in today.tasks.values():
        cells, ranked = board_cells(stored.results), standings(stored.results, _metric(stored))
        for label, cell in cells.items():
            model = stored.results.layout.model(label).name
            found.setdefault(model, []).append(_place(stored, label, cell, ranked))
    return found


def _place(stored: Stored, label: str, cell: BoardCell, ranked: Sequence[Standing]) -> Place:
    results = stored.results
    own = {standing.label: standing for standing in ranked}.get(label)
    return Place(
        task=results.layout.name,
        title=results.layout.page.title,
        short=results.layout.page.short,
        label=label,
        profile=stored.profile,
        metric=_metric(stored),
        mean=cell.text,
        rank=1 + ranked.index(own) if own else None,
        n_ranked=len(ranked),
        shade=cell.shade,
        finding=_finding(own),
        beaten_by=(reference_of(results) or "") if cell.beaten else "",
        seconds=_seconds(stored, label),
    )


def _metric(stored: Stored) -> str:
    return first_metric(stored.results)


def _finding(own: Standing | None) -> str:
    tested = own is not None and own.standing in (Lead.BEHIND, Lead.INSEPARABLE)
    return own.standing.value if own is not None and tested else ""


def _seconds(stored: Stored, label: str) -> float | None:
    """Return what a fit took in this task; None where there is no record of it."""
    durations = typical(stored.profile)
    kinds = alike(Address(stored.results.layout.name, 0, "", 0, label))[:1]
    return durations.expect_seconds(kinds) if durations.knows(kinds) else None


def two_digits(seconds: float) -> str:
    """Return a number as text of two digits, or more where it is above 100."""
    return f"{seconds:.2g}" if seconds < 10 else f"{seconds:.0f}"
