"""The entrants of a leaderboard: the records of all submissions, side by side in one table."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from math import inf, isnan
from typing import Any

from mocapbench.basics.words import format_count
from mocapbench.benchmark.errors import UnknownNameError, UsageError
from mocapbench.benchmark.merging.reconcile import MergedRun
from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.results.model_infos import model_infos
from mocapbench.benchmark.results.origins import recordings
from mocapbench.benchmark.runs.posed import PosedProblems
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address

__all__ = ["describe_entrants", "unite_submissions"]

Submission = tuple[Mapping[str, Any], MergedRun]
"""What an archive says of itself, and the run in it."""

_RANGE = re.compile(r"([−-]?[\d.]+|−∞) to (−?[\d.]+|∞)")
_CORES = re.compile(r"[0-9]{1,5}")
_ROUNDING = 1e-9
"""By which sums may miss the end of a range."""
_LARGEST = 1e100
"""In size: what a figure can be drawn of."""


def unite_submissions(submissions: Mapping[str, Submission]) -> dict[str, list[Record]]:
    """Return the records of each archive, with labels under which all stand in one table.

    Of an entrant that two archives have alike, job by job, the first one's counts, with the good
    record of each job. One whose results are others is named after who sent it.

    Parameters
    ----------
    submissions : mapping of str to (mapping, MergedRun)
        By the path of the archive, in the order of the table.

    Raises
    ------
    UsageError
        If two have different scores of one job, other seeds, other recordings of one name or other
        problems; or one has what there is not here: a task, a version of it, a case or a value that
        its metric cannot have.
    """
    planned = {path: _list_planned(path, run) for path, (_, run) in submissions.items()}
    _require_same(planned, "seed", lambda record: {"the seed": str(record.seed)})
    _require_same(planned, "recording", recordings)
    _require_same(planned, "score", _describe_scores)
    _require_same_problems(planned)
    good = {r.key: r for records in planned.values() for r in records if r.status is Status.OK}
    taken: dict[tuple[str, str], set[str]] = {}
    return {
        path: [
            replace(good.get(record.key, record), address=record.address)
            for record in _name_entrants(planned[path], about["by"], taken, path)
        ]
        for path, (about, _) in submissions.items()
    }


def _list_planned(archive: str, run: MergedRun) -> list[Record]:
    """Return the records of a run in table order, with the scores that are known here."""
    known = {*METRICS.names()}
    found = (run.records[job.key] for job in run.jobs if job.key in run.records)
    records = [
        replace(r, scores={name: v for name, v in r.scores.items() if name in known}) for r in found
    ]
    for record in records:
        _require_here(archive, record.address)
        _require_possible(archive, record)
    return records


def _require_here(archive: str, address: Address) -> None:
    """Refuse a row of a task, or of a version of it, that there is not here."""
    try:
        task = TASKS.get(address.task)
        task.case(address.case)
    except UnknownNameError as error:
        said, _, _ = str(error).partition(" (if a file")
        raise UsageError(f"{archive}: {said}; this version of mocapbench lacks it") from error
    if task.version != address.version:
        raise UsageError(
            f"{archive}: expected version {task.version} of {task.name}, got {address.version}: "
            "another problem, whose scores cannot be compared; have it run with this version"
        )
    if address.fold is None:
        raise UsageError(f"{archive}: expected the fold of {address}, got none")


def _require_possible(archive: str, record: Record) -> None:
    """Refuse scores that a metric cannot have, and those of a job that did not go well."""
    if record.scores and record.status is not Status.OK:
        raise UsageError(
            f"{archive}: expected no score of {record.address}, which is {record.status}, got some"
        )
    for name, value in record.scores.items():
        low, high = _read_range(METRICS.get(name).range)
        if not (isnan(value) or (low <= value <= high and abs(value) < _LARGEST)):
            raise UsageError(
                f"{archive}: expected {name} of {record.address} from {max(low, -_LARGEST):g} to "
                f"{min(high, _LARGEST):g}, got {value:g}"
            )


def _read_range(text: str) -> tuple[float, float]:
    """Return the least and the largest value of a metric; of one that does not tell, any."""
    found = _RANGE.match(text)
    if not found:
        return -inf, inf
    low, high = (float(end.replace("−", "-").replace("∞", "inf")) for end in found.groups())
    return low - _ROUNDING, high + _ROUNDING


def _describe_scores(record: Record) -> Mapping[str, str]:
    return {f"{name} of {record.key[:12]}…": repr(v) for name, v in record.scores.items()}


def _require_same(
    planned: Mapping[str, Iterable[Record]],
    what: str,
    describe: Callable[[Record], Mapping[str, str]],
) -> None:
    """Refuse archives that say different things under one name."""
    first: dict[str, tuple[str, str]] = {}
    for archive, records in planned.items():
        facts = dict.fromkeys(item for record in records for item in describe(record).items())
        for name, got in facts:
            other, expected = first.setdefault(name, (archive, got))
            if got != expected:
                raise UsageError(
                    f"expected one {what} of each name, got two of {name}: {expected} in {other}, "
                    f"{got} in {archive}; leave one of the archives out"
                )


def _require_same_problems(planned: Mapping[str, Iterable[Record]]) -> None:
    posed = PosedProblems()
    for archive, records in planned.items():
        for record in records:
            if posed.check_record(record) is not record:
                raise UsageError(
                    f"{archive}: expected the problem of {record.address} that the others have, "
                    "got another; leave one of the archives out"
                )


def _name_entrants(
    records: Sequence[Record], by: str, taken: dict[tuple[str, str], set[str]], archive: str
) -> Iterable[Record]:
    """Yield the records of new entrants, under names that no other has; take these names."""
    names: dict[tuple[str, str], str] = {}
    for (task, label), of_entrant in _group_by_entrant(records).items():
        keys = {record.key for record in of_entrant}
        name = f"{label} ({by})" if (task, label) in taken else label
        if any(keys <= taken.get((task, known), set()) for known in (label, name)):
            continue
        if (task, name) in taken:
            raise UsageError(
                f"{archive}: expected one result of {label} of {task} by {by}, got another in an "
                "archive before; leave one of them out, or have it sent by another --by"
            )
        taken[task, name], names[task, label] = keys, name
    for record in records:
        address = record.address
        if name := names.get((address.task, address.label), ""):
            yield replace(record, address=address._replace(label=name))


def _group_by_entrant(records: Iterable[Record]) -> dict[tuple[str, str], list[Record]]:
    groups: dict[tuple[str, str], list[Record]] = {}
    for record in records:
        groups.setdefault((record.address.task, record.address.label), []).append(record)
    return groups


def describe_entrants(
    submissions: Mapping[str, Submission], united: Mapping[str, Sequence[Record]]
) -> list[dict[str, Any]]:
    """Return what a table says of each entrant, in its order.

    Each is a mapping: ``label``, ``by``, ``link``, ``paper``, ``code``, ``licence``, ``hardware``,
    the ``profile`` of the run with what it sets of the model, ``tasks`` and ``jobs`` with a result,
    and ``lacking``, jobs without one: texts but for the last two.

    Parameters
    ----------
    submissions : mapping
        As for `unite_submissions`.
    united : mapping of str to list of Record
        Its result.
    """
    return [
        {
            **_count_jobs(of_label, submissions[archive]),
            "profile": _describe_profile(of_label, submissions[archive][1]),
            **_describe_sender(submissions[archive][0]),
            **_describe_model(submissions[archive][0], of_label[0]),
        }
        for archive, records in united.items()
        for of_label in _split_by_label(records)
    ]


def _split_by_label(records: Iterable[Record]) -> list[list[Record]]:
    groups: dict[str, list[Record]] = {}
    for record in records:
        groups.setdefault(record.address.label, []).append(record)
    return [*groups.values()]


def _count_jobs(records: Sequence[Record], submission: Submission) -> dict[str, Any]:
    about, run = submission
    done = [record for record in records if record.status is Status.OK]
    label = records[0].address.label
    names = {label, label.removesuffix(f" ({about['by']})")}
    tasks = {record.address.task for record in records}
    planned = [j for j in run.jobs if j.address.label in names and j.address.task in tasks]
    machines = dict.fromkeys(_name_machine(record.provenance) for record in done or records)
    return {
        "label": label,
        "tasks": ", ".join(dict.fromkeys(record.address.task for record in done)),
        "jobs": len(done),
        "lacking": len(planned) - len(done),
        "hardware": "; ".join(machines),
    }


def _describe_profile(records: Sequence[Record], run: MergedRun) -> str:
    """Return the profile of a run, and what its budget sets of the model of some records."""
    profiles = dict.fromkeys(provenance.get("profile", "") for provenance in run.runs)
    budgets = (TASKS.get(r.address.task).profiles.get(p) for r in records for p in profiles)
    names = {name for budget in budgets if budget for name in budget.budget}
    said = (f"{k}={v}" for r in records for k, v in r.parameters.items() if k in names)
    return ", ".join(filter(None, [*profiles, *dict.fromkeys(said)]))


def _name_machine(provenance: Mapping[str, str]) -> str:
    cores = provenance.get("cores", "")
    of = f", {format_count(int(cores), 'core')}" if _CORES.fullmatch(cores) else ""
    return f"{provenance.get('CPU', 'unknown')}{of}"


def _describe_sender(about: Mapping[str, Any]) -> dict[str, str]:
    return {"by": about["by"], "link": about.get("link", "")}


def _describe_model(about: Mapping[str, Any], record: Record) -> dict[str, str]:
    """Return paper, code and licence, as the sender says, else as far as they are known here."""
    label = record.address.label.removesuffix(f" ({about['by']})")
    models = about.get("models", {})
    said = models.get(label) or models.get(record.model) or {}
    (known,) = model_infos(TASKS.get(record.address.task), [record]).values()
    return {"paper": known.source, "code": "", "licence": "", **said}
