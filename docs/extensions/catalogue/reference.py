"""The results that pages show: those of the stored reference values, as the report reads them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from mocapbench.benchmark.gate.reference import Reference
from mocapbench.benchmark.gate.reference_files import read_reference
from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.results.bundle import bundle
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.runs.request import entrants
from mocapbench.benchmark.tasks.address import Address
from mocapbench.reports.analysis.results import TaskResults, task_results
from mocapbench.reports.figures.styles import DrawingStyle, model_styles

__all__ = ["Stored", "Today", "read_today"]

PROFILES = ("quick", "smoke")
"""In this order: a task that the first lacks is shown by the second."""


@dataclass(frozen=True)
class Stored:
    """The results of one task, and the profile that they are of."""

    profile: str
    results: TaskResults


@dataclass(frozen=True, eq=False)
class Today:
    """The results of all tasks that there are reference values of.

    Parameters
    ----------
    tasks : mapping of str to Stored
    """

    tasks: Mapping[str, Stored]

    @cached_property
    def styles(self) -> Mapping[str, DrawingStyle]:
        """How each label is drawn, on all pages alike."""
        return model_styles([stored.results.layout for stored in self.tasks.values()])


def read_today(folder: Path) -> Today:
    """Return the results of the reference values in ``folder``, which has a folder a profile."""
    tasks: dict[str, Stored] = {}
    for profile in PROFILES:
        reference = read_reference(folder / profile)
        for results in _results(reference, profile) if reference else ():
            tasks.setdefault(results.layout.name, Stored(profile, results))
    return Today(tasks)


def _results(reference: Reference, profile: str) -> Iterator[TaskResults]:
    whole = bundle(_records(reference), {"profile": profile})
    return (task_results(whole, layout) for layout in whole.layouts)


def _records(reference: Reference) -> list[Record]:
    """Return a record for each fold of each entrant, entrants of a task in table order."""
    scores: dict[Address, dict[str, float]] = {}
    for series, folds in reference.values.items():
        for fold, value in folds.items():
            scores.setdefault(series.address._replace(fold=fold), {})[series.metric] = value
    models = {task: _models(task) for task in {address.task for address in scores}}
    return [
        Record("", "", address, 0, models[address.task][address.label], {}, Status.OK, scores=own)
        for address, own in sorted(scores.items(), key=lambda item: _place(item[0], models))
    ]


def _place(address: Address, models: Mapping[str, Mapping[str, str]]) -> int:
    return [*models[address.task]].index(address.label)


def _models(task: str) -> dict[str, str]:
    """Return the model of each label of a task, in table order."""
    return {entrant.label: entrant.model for entrant in entrants(TASKS.get(task))}
