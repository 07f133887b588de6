"""The line of trust: what ran, on what, and what is missing."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import STATUSES, Bundle

__all__ = ["trust"]

ABOUT = ("wall time", "CPU", "started")


def trust(bundle: Bundle, tasks: Sequence[TaskResults]) -> list[str]:
    """Return what a reader has to know before the first number, in few words each."""
    profile = bundle.provenance.get("profile")
    reduced = ", reduced budgets" if any(task.layout.budget for task in tasks) else ""
    return [
        *([f"profile {profile}{reduced}"] if profile else []),
        f"{format_count(len(tasks), 'task')}, {_cases(tasks)}, {_folds(bundle)}",
        _jobs(bundle),
        *(bundle.provenance[name] for name in ABOUT if name in bundle.provenance),
    ]


def _cases(tasks: Sequence[TaskResults]) -> str:
    scored = sum(len({case for case, _, _ in task.estimates}) for task in tasks)
    planned = sum(len(task.cases) for task in tasks)
    return (
        format_count(planned, "case")
        if scored == planned
        else f"{scored} of {planned} cases scored"
    )


def _folds(bundle: Bundle) -> str:
    done = bundle.records[bundle.records["status"] == "ok"]
    counts = done.groupby(["task", "case"])["fold"].nunique()
    least, most = (counts.min(), counts.max()) if len(counts) else (0, 0)
    return f"{least} to {most} folds" if least < most else format_count(int(most), "fold")


def _jobs(bundle: Bundle) -> str:
    counts = Counter(bundle.records["status"])
    named = [(status.replace("-", " "), counts[status]) for status in STATUSES if counts[status]]
    if not named:
        return "no job ran"
    return ", ".join(
        [
            f"{format_count(named[0][1], 'job')} {named[0][0]}",
            *(f"{n} {name}" for name, n in named[1:]),
        ]
    )
