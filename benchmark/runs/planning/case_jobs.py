"""The jobs of one case: one for each entrant and fold, with the keys of what it computes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import METRICS, MODELS
from mocapbench.benchmark.runs.job import Job
from mocapbench.benchmark.runs.key_parts import key_parts
from mocapbench.benchmark.runs.keys import (
    fit_contents,
    key_of,
    metric_contents,
    score_contents,
    training_contents,
)
from mocapbench.benchmark.runs.planning.parameters import full_parameters
from mocapbench.benchmark.runs.planning.request import Request
from mocapbench.benchmark.runs.planning.selection import chosen_entrants, chosen_folds
from mocapbench.benchmark.tasks.address import Address
from mocapbench.benchmark.tasks.base import Case, Entrant, Task
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive

__all__ = ["case_jobs", "missing_recordings"]

_MISSING = "missing"


def case_jobs(request: Request, task: Task, case: Case, archive: Archive) -> Iterator[Job]:
    """Yield the jobs of one case: by entrant, then by fold."""
    missing = missing_recordings(task, case, archive)
    digests = {uri: _MISSING if uri in missing else archive.digest(uri) for uri in case.recordings}
    metrics = tuple(sorted(set(request.metrics or METRICS.names())))
    common = _Common(task, case, request.seed, metrics, digests, missing)
    for entrant in chosen_entrants(request, task):
        parameters = full_parameters(entrant, case, task.profile(request.profile))
        for fold in range(chosen_folds(request, task)):
            yield _job(common, entrant, parameters, fold)


def missing_recordings(task: Task, case: Case, archive: Archive) -> tuple[str, ...]:
    """Return the addresses of a case's recordings that are not at hand.

    Raises
    ------
    UsageError
        If ``archive`` has no library for an address.
    """
    try:
        return tuple(uri for uri in case.recordings if not archive.available(uri))
    except ValueError as error:  # no such library, or a malformed address
        raise UsageError(f"task {task.name!r}, case {case.name!r}: {error}") from error


@dataclass(frozen=True)
class _Common:
    """What the jobs of a case have in common."""

    task: Task
    case: Case
    seed: int
    metrics: tuple[str, ...]
    digests: Mapping[str, str]
    missing: tuple[str, ...]

    @cached_property
    def scored_by(self) -> Mapping[str, Any]:
        return metric_contents(map(METRICS.get, self.metrics))


def _job(common: _Common, entrant: Entrant, parameters: Mapping[str, Any], fold: int) -> Job:
    task, case, digests = common.task, common.case, common.digests
    seen, compared = ({uri: digests[uri] for uri in of} for of in (case.sources, case.references))
    address = Address(task.name, task.version, case.name, fold, entrant.label)
    seeds = Seeds(common.seed, address._replace(case=case.problem_name))
    model = MODELS.get(entrant.model)
    fitted = fit_contents(case, seeds, model=model, parameters=parameters, digests=seen)
    fit, learnt = key_of(fitted), seeds.of_training(case.training)
    scored = score_contents(fit, common.scored_by, case.name, compared)
    return Job(
        address=address,
        seeds=seeds,
        training_seeds=learnt,
        model=entrant.model,
        parameters=parameters,
        metrics=common.metrics,
        key=key_of(scored),
        fit_key=fit,
        training_key=key_of(training_contents(fitted, learnt)) if case.training else "",
        digests=digests,
        missing=common.missing,
        parts=key_parts(fitted, scored),
    )
