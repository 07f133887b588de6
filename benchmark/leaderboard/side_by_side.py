"""The entrants of a leaderboard: the records of all submissions, side by side in one table."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from mocapbench.basics.words import format_count
from mocapbench.benchmark.errors import UnknownNameError, UsageError
from mocapbench.benchmark.merging.reconcile import MergedRun, unite_records
from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.results.model_infos import model_infos
from mocapbench.benchmark.results.origins import recordings
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.tasks.address import Address

__all__ = ["describe_entrants", "unite_submissions"]

Submission = tuple[Mapping[str, Any], MergedRun]
"""What an archive says of itself, and the run in it."""


def unite_submissions(submissions: Mapping[str, Submission]) -> dict[str, list[Record]]:
    """Return the records of each archive, with labels under which all stand in one table.

    Where two archives have different results in one row, the later one's entrant is named after
    who sent it; where they have the same, the first one's counts.

    Parameters
    ----------
    submissions : mapping of str to (mapping, MergedRun)
        By the name of the archive, in the order of the table.

    Raises
    ------
    UsageError
        If two have different scores of one job or different recordings of one name, or one has a
        task, a version of it or a case that there is not here.
    """
    unite_records([run for _, run in submissions.values()])
    planned = {name: _list_planned(name, run) for name, (_, run) in submissions.items()}
    _require_same_recordings(planned)
    taken: dict[Address, str] = {}
    return {
        name: list(_name_entrants(planned[name], about["by"], taken, name))
        for name, (about, _) in submissions.items()
    }


def _list_planned(archive: str, run: MergedRun) -> list[Record]:
    """Return the records of a run in table order, with the scores that are known here."""
    found = (run.records[job.key] for job in run.jobs if job.key in run.records)
    known = {*METRICS.names()}
    records = [
        replace(r, scores={name: v for name, v in r.scores.items() if name in known}) for r in found
    ]
    for record in records:
        _require_here(archive, record.address)
    return records


def _require_here(archive: str, address: Address) -> None:
    """Refuse a row of a task, or of a version of it, that there is not here."""
    try:
        task = TASKS.get(address.task)
        task.case(address.case)
    except UnknownNameError as error:
        raise UsageError(f"{archive}: {error}; this version of mocapbench lacks it") from error
    if task.version != address.version:
        raise UsageError(
            f"{archive}: expected version {task.version} of {task.name}, got {address.version}: "
            "another problem, whose scores cannot be compared; have it run with this version"
        )


def _require_same_recordings(planned: Mapping[str, Iterable[Record]]) -> None:
    first: dict[str, tuple[str, str]] = {}
    for archive, records in planned.items():
        facts = dict.fromkeys(item for record in records for item in recordings(record).items())
        for uri, digest in facts:
            other, expected = first.setdefault(uri, (archive, digest))
            if digest != expected:
                raise UsageError(
                    f"expected one recording of each name, got two of {uri}: {expected} in "
                    f"{other}, {digest} in {archive}; leave one of the archives out"
                )


def _name_entrants(
    records: Sequence[Record], by: str, taken: dict[Address, str], archive: str
) -> Iterable[Record]:
    """Yield the records that are new, under names that no other result has; take their rows."""
    others = {
        (record.address.task, record.address.label)
        for record in records
        if taken.get(record.address, record.key) != record.key
    }
    for record in records:
        address = record.address
        if (address.task, address.label) in others:
            address = address._replace(label=f"{address.label} ({by})")
        elif address in taken:
            continue
        if taken.setdefault(address, record.key) != record.key:
            raise UsageError(
                f"{archive}: expected one result of {address}, got another in an archive before, "
                "also by this sender; leave one of them out, or have it sent by another --by"
            )
        yield replace(record, address=address)


def describe_entrants(
    submissions: Mapping[str, Submission], united: Mapping[str, Sequence[Record]]
) -> list[dict[str, Any]]:
    """Return what a table says of each entrant, in its order.

    Each is a mapping: ``label``, ``by``, ``link``, ``paper``, ``code``, ``licence``, ``hardware``,
    ``tasks`` and ``jobs`` with a result, and ``failed``, texts but for the last two.

    Parameters
    ----------
    submissions : mapping
        As for `unite_submissions`.
    united : mapping of str to list of Record
        Its result.
    """
    return [
        {
            **_count_jobs(of_label),
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


def _count_jobs(records: Sequence[Record]) -> dict[str, Any]:
    done = [record for record in records if record.status is Status.OK]
    tasks = dict.fromkeys(record.address.task for record in done)
    machines = dict.fromkeys(_name_machine(record.provenance) for record in done or records)
    return {
        "label": records[0].address.label,
        "tasks": ", ".join(tasks),
        "jobs": len(done),
        "failed": sum(record.status.broken for record in records),
        "hardware": "; ".join(machines),
    }


def _name_machine(provenance: Mapping[str, str]) -> str:
    cores = provenance.get("cores", "")
    of = f", {format_count(int(cores), 'core')}" if cores.isdecimal() else ""
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
