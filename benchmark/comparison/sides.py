"""The two sides of a comparison: two runs, or two models of one run."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from mocapbench.benchmark.errors import UnknownNameError, UsageError
from mocapbench.benchmark.runs.directory import RunDirectory
from mocapbench.benchmark.runs.plan_document import planned_jobs
from mocapbench.benchmark.runs.record import Record, Status

__all__ = ["Side", "between_models", "between_runs", "planned_side", "side_names"]

Side = Sequence[Record]


def planned_side(store: RunDirectory) -> Side:
    """Return the records of a run's plan, and for jobs without one a record that says so."""
    records = store.planned()
    found = {record.key for record in records}
    lacking = [
        Record(
            *(job.key, job.fit_key, job.address, 0, job.address.label, {}, Status.FAILED),
            message="no result yet",
        )
        for job in planned_jobs(store.load_plan())
        if job.key not in found
    ]
    return [*records, *lacking]


def between_runs(first: Side, second: Side, models: Sequence[str] = ()) -> tuple[Side, Side]:
    """Return the records of both runs, of the entrants that ``models`` names, or of all.

    Raises
    ------
    UnknownNameError
        If neither run has an entrant of that label or model.
    """
    one, other = (_of_models(side, models or _labels(side)) for side in (first, second))
    _require_models(models, [*first, *second])
    return one, other


def between_models(run: Side, models: Sequence[str]) -> tuple[Side, Side]:
    """Return the records of two entrants of one run, without their labels.

    Raises
    ------
    UsageError
        If ``models`` are not two different labels of the run.
    """
    if len(set(models)) != 2:
        raise UsageError(
            "compare: expected a second run, or --models with two labels of the one run, got "
            f"{', '.join(models) or 'neither'}"
        )
    _require_models(models, run)
    one, other = (
        [replace(r, address=r.address._replace(label="")) for r in _of_models(run, [name])]
        for name in models
    )
    return one, other


def side_names(one: Path, other: Path) -> tuple[str, str]:
    """Return the folders' names, which tables have room for, or their paths where these agree."""
    names = one.resolve().name, other.resolve().name
    return names if names[0] != names[1] else (str(one), str(other))


def _labels(side: Side) -> set[str]:
    return {record.address.label for record in side}


def _of_models(side: Side, models: Iterable[str]) -> list[Record]:
    return [record for record in side if record.address.label in set(models)]


def _require_models(models: Iterable[str], side: Side) -> None:
    known = sorted(_labels(side))
    for name in models:
        if name not in known:
            raise UnknownNameError("entrant of the run", name, known)
