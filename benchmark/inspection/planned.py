"""What a plan holds, what it lacks and how long it takes, for ``mocapbench run --dry-run``."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from rich.table import Column, Table

from mocapbench.basics.words import format_count
from mocapbench.benchmark.inspection.explanation import explain
from mocapbench.benchmark.inspection.forecast import (
    forecast_lines,
    lacking,
    lacking_line,
)
from mocapbench.benchmark.runs.job import Job

__all__ = ["forecast_text", "plan_table"]


def plan_table(planned: Sequence[Job]) -> Table:
    """Return the tasks with their cases, entrants and folds, those together that have the same."""
    table = Table(Column(no_wrap=True), Column(overflow="fold"), show_header=False, box=None)
    for (task, labels, folds), cases in _rows(planned).items():
        factors = ((cases, "case"), (labels, "entrant"), (range(folds), "fold"))
        product = " × ".join(format_count(len(several), noun) for several, noun in factors)
        n_jobs = format_count(len(cases) * len(labels) * folds, "job")
        table.add_row(task, f"{n_jobs} = {product}")
        table.add_row("  cases", ", ".join(cases))
        table.add_row("  entrants", ", ".join(labels))
    return table


def forecast_text(
    planned: Sequence[Job], profile: str, out: Path, n_workers: int | None, remedy: str
) -> Iterator[str]:
    """Yield how many jobs there are, how long they take, and which recordings are missing.

    Parameters
    ----------
    planned : sequence of Job
    profile : str
    out : Path
        The run directory.
    n_workers : int or None
        How many jobs would run at once; None if a cluster decides.
    remedy : str
        What to do about missing recordings.
    """
    yield format_count(len(planned), "job")
    yield from forecast_lines(planned, explain(planned, out), out, profile, n_workers)
    if lacking(planned):
        yield lacking_line(planned, remedy)


def _rows(planned: Sequence[Job]) -> Mapping[tuple[str, tuple[str, ...], int], list[str]]:
    """Return the cases by what they have in common: task, entrants and number of folds."""
    labels: dict[tuple[str, str], dict[str, None]] = defaultdict(dict)
    folds: dict[tuple[str, str], set[int | None]] = defaultdict(set)
    for address in (job.address for job in planned):
        labels[address.task, address.case][address.label] = None
        folds[address.task, address.case].add(address.fold)
    rows: dict[tuple[str, tuple[str, ...], int], list[str]] = defaultdict(list)
    for (task, case), entrants in labels.items():
        rows[task, tuple(entrants), len(folds[task, case])].append(case)
    return rows
