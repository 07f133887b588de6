"""Evaluation of one job: pose its problem, have its model predict, and score the prediction."""

from __future__ import annotations

import resource
from collections.abc import Callable
from typing import Any, NamedTuple

from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.registry import TASKS
from mocapbench.benchmark.runs.fit_attempt import FitAttempt, attempt_fit
from mocapbench.benchmark.runs.fitting.fit import Fit
from mocapbench.benchmark.runs.fitting.trained import Trained
from mocapbench.benchmark.runs.job import Job, Work, WorkerConfig
from mocapbench.benchmark.runs.posed import problem_digest
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.runs.scoring import scoring
from mocapbench.datasets import Archive

__all__ = ["Evaluation", "evaluate"]


class Evaluation(NamedTuple):
    """What became of a job, and what of it is new."""

    record: Record
    fit: Fit | None = None
    """The predictions."""
    trained: Trained | None = None
    """The fitted model, where other jobs can use it."""


def _here(function: Callable[..., FitAttempt], *arguments: Any) -> FitAttempt:
    return function(*arguments)


def evaluate(
    work: Work, config: WorkerConfig, archive: Archive, call: Callable[..., FitAttempt] = _here
) -> Evaluation:
    """Return the record of a job, and what others can use of it.

    Whatever the task, the model or a metric raises becomes a failed record; that of a metric has
    the scores of the others. The process's memory is limited from now on.

    Parameters
    ----------
    work : Work
    config : WorkerConfig
    archive : Archive
        Where recordings come from.
    call : callable
        Calls the function that it gets first with the other arguments: the model's part, which
        posing and scoring need not share a process with. What it raises itself is for the caller.
    """
    job = work.job
    try:
        resource.setrlimit(resource.RLIMIT_AS, (config.memory, resource.RLIM_INFINITY))
        problem = TASKS.get(job.address.task).case(job.address.case).problem(job.seeds, archive)
    except BaseException as error:
        return Evaluation(job.record_failure(error, config.memory))
    if work.fit is not None:
        return Evaluation(_record(work, work.fit, problem, config))
    fit, trained, failure = call(attempt_fit, work, problem, config)
    if fit is not None:
        return Evaluation(_record(work, fit, problem, config), fit, trained)
    assert failure is not None
    return Evaluation(failure, None, trained)


def _record(work: Work, fit: Fit, problem: Problem[Any], config: WorkerConfig) -> Record:
    try:
        return _score_fit(work, fit, problem, config)
    except BaseException as error:
        return work.job.record_failure(error, config.memory)


def _score_fit(work: Work, fit: Fit, problem: Problem[Any], config: WorkerConfig) -> Record:
    costs = {**fit.costs, "warnings": (*fit.warnings, *work.remarks)}
    found = scoring(work.job, problem, fit)
    results = {"problem": problem_digest(problem), **costs, **found.results}
    provenance = _provenance(work.job, config)
    return work.job.record(found.status, found.message, **results, provenance=provenance)


def _provenance(job: Job, config: WorkerConfig) -> dict[str, str]:
    digests = {f"digest of {uri}": digest for uri, digest in job.digests.items()}
    return {**config.provenance, **digests}
