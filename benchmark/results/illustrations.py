"""The illustrations of a run: made from stored answers when the report is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import isfinite, nan

from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.internals import Internals
from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.results.interpolations import interpolates
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.runs.store import Store
from mocapbench.benchmark.tasks.base import Case, Task
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive, FormatError, Library, Recording, RecordingUnavailable
from mocapbench.reports import Picture

__all__ = ["illustrations"]


def illustrations(records: Sequence[Record], store: Store, archive: Archive) -> tuple[Picture, ...]:
    """Return the figures of every task: of the first case that it names and that has answers.

    The problem is posed again, which takes its recordings; a case that lacks them, or of which one
    has changed since, is not shown.
    """
    archive = _ReadOnce(archive.libraries)
    tasks = [TASKS.get(name) for name in dict.fromkeys(r.address.task for r in records)]
    return tuple(
        picture
        for task in tasks
        for picture in _illustrate(task, _chosen(task, records), store, archive)
    )


def _chosen(task: Task, records: Sequence[Record]) -> list[Record]:
    """Return the records of the case to show, at the first fold that has any."""
    done = [r for r in records if r.address.task == task.name and r.status is Status.OK]
    ran = {record.address.case for record in done}
    case = next((name for name in task.page.illustrated if name in ran), None)
    of_case = [record for record in done if record.address.case == case]
    first = min((record.address.fold or 0 for record in of_case), default=0)
    return [record for record in of_case if record.address.fold == first]


def _illustrate(
    task: Task, records: Sequence[Record], store: Store, archive: Archive
) -> Sequence[Picture]:
    fits = {record.address.label: store.load_fit(record.fit_key) for record in records}
    arrays = {label: fit.arrays for label, fit in fits.items() if fit is not None}
    if not arrays:
        return ()
    case = task.case(records[0].address.case)
    address = records[0].address._replace(case=case.problem_name)
    try:
        if not _as_they_were(case, records[0], archive):
            return ()
        problem = case.problem(Seeds(records[0].seed, address), archive)
    except (RecordingUnavailable, FormatError):
        return ()
    solved = Solved(
        task.name,
        problem,
        {label: problem.answer_type.from_arrays(of_label) for label, of_label in arrays.items()},
        {label: Internals.from_arrays(of_label) for label, of_label in arrays.items()},
        task.page.published_models,
        *_ranked(task, records),
        archive,
    )
    suffix = " (synthetic)" if case.synthetic else ""
    return [
        replace(picture, title=f"{picture.title}: {case.problem_name}{suffix}")
        for figure in task.page.figures
        for picture in figure.pictures(solved)
    ]


def _ranked(task: Task, records: Sequence[Record]) -> tuple[tuple[str, ...], str, frozenset[str]]:
    """Return the labels that have the first metric, best first; its title; the interpolations."""
    name = task.page.metrics[0]
    metric = METRICS.get(name)
    scores = {record.address.label: record.scores.get(name, nan) for record in records}
    scored = [label for label, value in scores.items() if isfinite(value)]
    order = sorted(scored, key=lambda label: metric.direction.loss(scores[label], metric.target))
    interpolations = frozenset(r.address.label for r in records if interpolates(r.model))
    return tuple(order), metric.title, interpolations


class _ReadOnce(Archive):
    """An archive that reads a recording once: several tasks use the same."""

    def __init__(self, libraries: Mapping[str, Library]) -> None:
        super().__init__(libraries)
        self._known: dict[str, Recording] = {}

    def recording(self, uri: str) -> Recording:
        """Return a recording; see `Archive.recording`."""
        if uri not in self._known:
            self._known[uri] = super().recording(uri)
        return self._known[uri]


def _as_they_were(case: Case, record: Record, archive: Archive) -> bool:
    """Return whether the recordings of a case are those that the record is of."""
    digests = {uri: archive.digest(uri) for uri in case.recordings}
    kept = {uri: record.provenance.get(f"digest of {uri}", now) for uri, now in digests.items()}
    return kept == digests
