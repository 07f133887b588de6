"""Everything that changed from one run to another, for the page of two runs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from mocapbench.basics.words import format_count
from mocapbench.benchmark.comparison.folds import Pair, both_scored, records_by_address
from mocapbench.benchmark.comparison.problems import differences, require_same_problems
from mocapbench.benchmark.comparison.score_changes import score_changes
from mocapbench.benchmark.comparison.setup_changes import (
    changed_parameters,
    changed_provenance,
    changed_recordings,
)
from mocapbench.benchmark.comparison.sides import Side
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.results.bundle import metric_info
from mocapbench.benchmark.results.shown_metrics import shown_metrics
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address
from mocapbench.benchmark.tasks.base import Task
from mocapbench.reports import Change, MetricInfo, RunChanges

__all__ = ["run_changes"]

ByAddress = Mapping[Address, Record]


def run_changes(first: Side, second: Side, names: tuple[str, str]) -> RunChanges:
    """Return what changed from ``first`` to ``second``.

    Parameters
    ----------
    first, second : sequence of Record
    names : tuple of two str
        What to call the runs.

    Raises
    ------
    UsageError
        If they have no job in common, or no two jobs of one address solve the same problem.
    """
    one, other = (_by_address(side) for side in (first, second))
    common = [(record, other[address]) for address, record in one.items() if address in other]
    if not common:
        raise UsageError("report: the two runs have no (task, case, fold, entrant) in common")
    scored = [pair for pair in common if both_scored(pair)]
    pairs = [pair for pair in scored if not differences(*pair)]
    if not pairs:
        require_same_problems(scored)
    tasks = list(map(TASKS.get, dict.fromkeys(record.address.task for record, _ in pairs)))
    return RunChanges(
        names=names,
        titles={task.name: task.page.title for task in tasks},
        metrics={task.name: _metrics(task, [record for record, _ in pairs]) for task in tasks},
        scores=score_changes(_comparable(first, second)),
        newly_failing=_endings(common, without_score=1),
        newly_passing=_endings(common, without_score=0),
        parameters=changed_parameters(common),
        provenance=changed_provenance(first, second),
        recordings=changed_recordings(scored),
        unpaired=_count_unpaired(scored),
        only=(_only(one, other), _only(other, one)),
    )


def _by_address(side: Side) -> dict[Address, Record]:
    """Return the records by address, without the version, which `differences` compares."""
    return {record.address._replace(version=0): record for record in side}


def _metrics(task: Task, records: Sequence[Record]) -> dict[str, MetricInfo]:
    return {metric: metric_info(metric) for metric in shown_metrics(task, records)}


def _comparable(first: Side, second: Side) -> dict[Address, Pair]:
    """Return the jobs that both were asked for, but for those that solve different problems."""
    one, other = (records_by_address(side, ()) for side in (first, second))
    common = {address: (one[address], other[address]) for address in one if address in other}
    return {a: pair for a, pair in common.items() if not (both_scored(pair) and differences(*pair))}


def _endings(common: Iterable[Pair], *, without_score: int) -> list[Change]:
    """Return the jobs that ended well in only one run: not in run 0, or not in run 1."""
    scored = (without_score == 1, without_score == 0)
    return [
        Change(str(a.address), a.status.value, b.status.value, (a, b)[without_score].message)
        for a, b in common
        if (a.status is Status.OK, b.status is Status.OK) == scored and a.address == b.address
    ]


def _count_unpaired(scored: Iterable[Pair]) -> dict[str, int]:
    """Return why jobs are not compared, by reason; a job may have several."""
    reasons = Counter(reason for pair in scored for reason in differences(*pair))
    return dict(reasons.most_common())


def _only(these: ByAddress, those: ByAddress) -> list[str]:
    """Return the entrants with cells that only one run has, and how many."""
    theirs = {address.all_folds for address in those}
    cells = dict.fromkeys(a.all_folds for a in these if a.all_folds not in theirs)
    counts = Counter((address.task, address.label) for address in cells)
    return [
        f"{task}: {label} ({format_count(cases, 'case')})"
        for (task, label), cases in counts.items()
    ]
