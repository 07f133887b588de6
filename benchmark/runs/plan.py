"""Planning: from what the user asks for to the jobs that answer it."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.registry import METRICS, MODELS, UNCALIBRATED, find_calibration
from mocapbench.benchmark.runs.job import Job
from mocapbench.benchmark.runs.key_parts import key_parts
from mocapbench.benchmark.runs.keys import (
    fit_contents,
    key_of,
    metric_contents,
    score_contents,
    training_contents,
)
from mocapbench.benchmark.runs.request import (
    Request,
    chosen_cases,
    chosen_entrants,
    chosen_folds,
    consistent_tasks,
)
from mocapbench.benchmark.tasks.address import Address
from mocapbench.benchmark.tasks.base import Case, Entrant, Profile, Task
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive

__all__ = ["plan", "required_recordings"]

_MISSING = "missing"


def plan(request: Request, archive: Archive) -> tuple[Job, ...]:
    """Return the jobs of ``request`` in table order: task, case, entrant, fold.

    Raises
    ------
    UnknownNameError
        If a task, model, case, metric or profile does not exist.
    UsageError
        If a task does not have so many folds, or is not consistent (``require_consistent``).
    DigestMismatch
        If a recording is here but is not the registered one.
    """
    lookup = _Lookup(archive)
    return tuple(
        job
        for task in consistent_tasks(request)
        for case in chosen_cases(request, task)
        for job in _plan_case(request, task, case, lookup)
    )


def required_recordings(request: Request, archive: Archive) -> tuple[str, ...]:
    """Return the addresses of every recording that ``request`` needs, each once.

    Raises
    ------
    UnknownNameError, UsageError
        As `plan` does; and if ``archive`` has no library for an address.
    """
    tasks = [task for task in consistent_tasks(request) if chosen_entrants(request, task)]
    cases = [(task, case) for task in tasks for case in chosen_cases(request, task)]
    lookup = _Lookup(archive)
    for task, case in cases:
        lookup.list_missing(task, case)
    folds = ((case, fold) for task, case in cases for fold in range(chosen_folds(request, task)))
    return tuple(dict.fromkeys(uri for case, fold in folds for uri in case.recordings_in(fold)))


def _plan_case(request: Request, task: Task, case: Case, lookup: _Lookup) -> Iterator[Job]:
    """Yield the jobs of one case: by entrant, then by fold."""
    missing = lookup.list_missing(task, case)
    folds = range(chosen_folds(request, task))
    digests = [lookup.digests(case.recordings_in(fold)) for fold in folds]
    metrics = tuple(sorted(set(request.metrics or METRICS.names())))
    scored_by = metric_contents(map(METRICS.get, metrics))
    for address, entrant, seeds in _list_rows(request, task, case):
        of_fold = digests[seeds.fold]
        yield Job(
            address=address,
            seeds=seeds,
            training_seeds=seeds.of_training(case.training_in(seeds.fold)),
            model=entrant.model,
            parameters=entrant.parameters,
            metrics=metrics,
            digests=of_fold,
            missing=tuple(uri for uri in missing if uri in of_fold),
            **_name_results(case, seeds, entrant, of_fold, scored_by),
        )


def _list_rows(
    request: Request, task: Task, case: Case
) -> Iterator[tuple[Address, Entrant, Seeds]]:
    """Yield whose answer to which problem each job of a case is: by entrant, then by fold."""
    profile, folds = task.profile(request.profile), range(chosen_folds(request, task))
    for chosen in chosen_entrants(request, task):
        entrant = _complete_parameters(chosen, case, profile)
        # With the seeds of the calibrated one an uncalibrated entrant has the same means.
        label = entrant.label.removesuffix(UNCALIBRATED)
        for fold in folds:
            address = Address(task.name, task.version, case.name, fold, entrant.label)
            posed = address._replace(case=case.problem_name, label=label)
            yield address, entrant, Seeds(request.seed, posed)


def _name_results(
    case: Case,
    seeds: Seeds,
    entrant: Entrant,
    digests: Mapping[str, str],
    scored_by: Mapping[str, Any],
) -> dict[str, Any]:
    """Return the keys of a job, and what they cover."""
    taken = case.given_in(seeds.fold), case.references
    seen, compared = ({uri: digests[uri] for uri in of} for of in taken)
    fitted = fit_contents(
        case,
        seeds,
        model=MODELS.get(entrant.model),
        parameters=entrant.parameters,
        digests=seen,
        calibration=find_calibration(entrant.model),
    )
    fit = key_of(fitted)
    scored = score_contents(fit, scored_by, case.name, compared)
    shared = case.training_in(seeds.fold)
    training = training_contents(fitted, seeds.of_training(shared))
    return {
        "key": key_of(scored),
        "fit_key": fit,
        "training_key": key_of(training) if shared else "",
        "parts": key_parts(fitted, scored),
    }


class _Lookup:
    """Which recordings are at hand, and their digests, each read once: cases have many in common.

    Parameters
    ----------
    archive : Archive
    """

    def __init__(self, archive: Archive) -> None:
        self._is_available, self._digest = cache(archive.available), cache(archive.digest)

    def list_missing(self, task: Task, case: Case) -> tuple[str, ...]:
        """Return the addresses of a case's recordings that are not at hand.

        Raises
        ------
        UsageError
            If the archive has no library for an address.
        """
        try:
            return tuple(uri for uri in case.recordings if not self._is_available(uri))
        except ValueError as error:  # no such library, or a malformed address
            raise UsageError(f"task {task.name!r}, case {case.name!r}: {error}") from error

    def digests(self, uris: Iterable[str]) -> dict[str, str]:
        """Return the digests of recordings, or what stands for that of one that is missing."""
        return {uri: self._digest(uri) if self._is_available(uri) else _MISSING for uri in uris}


def _complete_parameters(entrant: Entrant, case: Case, profile: Profile) -> Entrant:
    """Return the entrant with all its model's parameters but the seed, which the label decides.

    Raises
    ------
    UsageError
        If one has no stable text, and so could be in no key or record.
    """
    model = MODELS.get(entrant.model)(**entrant.parameters)
    names = model.get_params()
    prescribed = {**profile.budget, **case.parameters}
    model.set_params(**{name: v for name, v in prescribed.items() if name in names})
    parameters = {name: v for name, v in model.get_params().items() if name != "random_state"}
    for name, value in parameters.items():
        _check_plain(entrant, name, value)
    return replace(entrant, parameters=parameters)


def _check_plain(entrant: Entrant, name: str, value: object) -> None:
    try:
        json.dumps(value)
    except (TypeError, ValueError) as error:
        raise UsageError(
            f"model {entrant.model!r}: expected parameters that JSON can hold (numbers, text, "
            f"lists of them), got {name}={value!r}; build objects from them in fit"
        ) from error
