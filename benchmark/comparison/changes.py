"""Everything that changed from one run to another, for the page of two runs.

They are the scores of cells, how jobs ended, and what the runs were made of and with: parameters,
versions, recordings. Folds are paired, and units tested, as `mocapbench compare` does it. Holm's
correction is over the scores of one task and metric that changed at all: a score that is the same
to the last digit needs no test.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from mocapbench.basics.words import format_count
from mocapbench.benchmark.comparison.folds import (
    Pair,
    both_scored,
    paired_folds,
    records_by_address,
)
from mocapbench.benchmark.comparison.problems import differences, require_same_problems
from mocapbench.benchmark.comparison.rows import Row, case_rows, correct_rows
from mocapbench.benchmark.comparison.sides import Side
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.results.bundle import metric_info
from mocapbench.benchmark.results.origins import DIGEST_OF, recordings
from mocapbench.benchmark.results.shown_metrics import shown_metrics
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address
from mocapbench.benchmark.tasks.base import Task
from mocapbench.reports import Change, MetricInfo, RunChanges, ScoreChange

__all__ = ["run_changes"]

ByAddress = Mapping[Address, Record]
_OF_THE_DAY = {"started", "wall time", "command line", "acknowledgement"}
_ABSENT = "–"


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
        scores=_list_score_changes(_comparable(first, second)),
        newly_failing=_endings(common, without_score=1),
        newly_passing=_endings(common, without_score=0),
        parameters=_list_changed_parameters(common),
        provenance=_list_changed_provenance(first, second),
        recordings=_list_changed_recordings(scored),
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


def _list_score_changes(common: Mapping[Address, Pair]) -> list[ScoreChange]:
    """Return every metric that the tables show of every cell, by task and metric, changed first.

    Parameters
    ----------
    common : mapping of Address to pair of Record
        The jobs that both runs were asked for; two with scores solve the same problem.
    """
    names = dict.fromkeys(address.task for address in common)
    return [
        change
        for task in map(TASKS.get, names)
        for metric in shown_metrics(task, (one for one, _ in common.values()))
        for change in _changes(task, metric, common)
    ]


def _changes(task: Task, metric: str, common: Mapping[Address, Pair]) -> list[ScoreChange]:
    rows = case_rows(task, metric, paired_folds(task.name, metric, common))
    identical = [row for row in rows if row.identical]
    changed = correct_rows([row for row in rows if not row.identical])
    return [_change(row) for row in (*changed, *identical) if row.contrast.n]


def _change(row: Row) -> ScoreChange:
    found = row.contrast
    return ScoreChange(
        task=row.task,
        case=row.case,
        label=row.entrant,
        metric=row.metric,
        n=found.n,
        first=found.first,
        second=found.second,
        low=-found.high,
        high=-found.low,
        verdict=row.verdict,
    )


def _list_changed_parameters(pairs: Iterable[Pair]) -> dict[tuple[str, Change], list[str]]:
    """Return every parameter of an entrant that differs within a pair, with its tasks."""
    tasks: dict[tuple[str, Change], dict[str, None]] = {}
    for one, other in pairs:
        for change in _differing(_texts(one.parameters), _texts(other.parameters)):
            tasks.setdefault((one.address.label, change), {})[one.address.task] = None
    return {change: list(where) for change, where in tasks.items()}


def _list_changed_provenance(first: Side, second: Side) -> list[Change]:
    """Return the versions and facts of machines of all records that differ between two runs."""
    return _differing(_provenance(first), _provenance(second))


def _list_changed_recordings(pairs: Iterable[Pair]) -> list[Change]:
    """Return the recordings of which the two runs had different files, with their digests."""
    return list(
        dict.fromkeys(
            fact for pair in pairs for fact in _differing(*(recordings(record) for record in pair))
        )
    )


def _texts(parameters: Mapping[str, object]) -> dict[str, str]:
    return {name: str(value) for name, value in parameters.items()}


def _provenance(side: Side) -> dict[str, str]:
    """Return the values of each fact in all records, which a resumed run may have several of."""
    values: dict[str, dict[str, None]] = {}
    for record in side:
        for name, value in record.provenance.items():
            if name not in _OF_THE_DAY and not name.startswith(DIGEST_OF):
                values.setdefault(name, {})[value] = None
    return {name: "; ".join(sorted(of_name)) for name, of_name in values.items()}


def _differing(before: Mapping[str, str], after: Mapping[str, str]) -> list[Change]:
    return [
        Change(name, before.get(name, _ABSENT), after.get(name, _ABSENT))
        for name in dict.fromkeys([*before, *after])
        if before.get(name) != after.get(name)
    ]
