"""Evaluation of one job: pose its problem, have its model answer, and score the answer."""

from __future__ import annotations

import math
import resource
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from mocapbench.benchmark.messages import reason
from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.runs.answering import Answered, answer
from mocapbench.benchmark.runs.fitting.fit import Fit
from mocapbench.benchmark.runs.fitting.trained import Trained
from mocapbench.benchmark.runs.job import Job, Work, WorkerConfig
from mocapbench.benchmark.runs.posed import problem_digest
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.score_values import fault_of_score
from mocapbench.datasets import Archive
from mocapbench.metrics import Metric, Score

__all__ = ["Evaluation", "evaluate"]


class Evaluation(NamedTuple):
    """What became of a job, and what of it is new."""

    record: Record
    fit: Fit | None = None
    """The predictions."""
    trained: Trained | None = None
    """The fitted model, where other jobs can use it."""


def _here(function: Callable[..., Answered], *arguments: Any) -> Answered:
    return function(*arguments)


def evaluate(
    work: Work, config: WorkerConfig, archive: Archive, call: Callable[..., Answered] = _here
) -> Evaluation:
    """Return the record of a job, and what others can use of it.

    Whatever the task, the model or a metric raises becomes a failed record. The process's memory
    is limited from now on.

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
        return Evaluation(job.failed(error, config.memory))
    if work.fit is not None:
        return Evaluation(_record(work, work.fit, problem, config))
    fit, trained, failure = call(answer, work, problem, config)
    if fit is not None:
        return Evaluation(_record(work, fit, problem, config), fit, trained)
    assert failure is not None
    return Evaluation(failure, None, trained)


def _record(work: Work, fit: Fit, problem: Problem[Any], config: WorkerConfig) -> Record:
    try:
        return _scored(work, fit, problem, config)
    except BaseException as error:
        return work.job.failed(error, config.memory)


def _scored(work: Work, fit: Fit, problem: Problem[Any], config: WorkerConfig) -> Record:
    costs = {**fit.costs, "warnings": (*fit.warnings, *work.remarks)}
    results = {"problem": problem_digest(problem), **costs, **_scores(work.job, problem, fit)}
    return work.job.record(Status.OK, **results, provenance=_provenance(work.job, config))


def _scores(job: Job, problem: Problem[Any], fit: Fit) -> dict[str, Any]:
    """Score by every metric that is defined for this outcome."""
    outcome = problem.outcome(problem.answer_type.from_arrays(fit.arrays))
    scores: dict[str, Score] = {}
    for name in job.metrics:
        scores |= _scored_by(METRICS.get(name), outcome)
    if not scores:
        raise ValueError(
            f"none of the metrics {', '.join(job.metrics)} is defined for the answer of "
            f"{job.address.label} to {job.address.task}; choose others with --metrics"
        )
    return {
        "scores": {name: float(score.value) for name, score in scores.items()},
        "parts": {
            name: {axis: values.tolist() for axis, values in score.parts.items()}
            for name, score in scores.items()
        },
        "left_out": {name: score.left_out for name, score in scores.items() if score.left_out},
    }


def _scored_by(metric: Metric[Any], outcome: object) -> dict[str, Score]:
    """Return the score by the metric's name, or nothing where the metric is not defined."""
    overflows: list[str] = []
    try:
        if not metric.applies(outcome):
            return {}
        with np.errstate(over="call", call=lambda kind, _: overflows.append(kind)):
            score: object = metric(outcome)
    except MemoryError:  # for `Job.failed`, which says what to do
        raise
    except BaseException as error:
        raise RuntimeError(f"the metric {metric.name!r} raised {reason(error)}") from error
    fault = fault_of_score(score)
    if fault:
        raise ValueError(f"expected the metric {metric.name!r} {fault}")
    assert isinstance(score, Score)
    _require_finite(metric.name, float(score.value), bool(overflows))
    return {metric.name: score}


def _require_finite(name: str, value: float, overflowed: bool) -> None:
    """Refuse a value that is infinite, or NaN because numbers on the way to it overflowed.

    Any other NaN says that the metric is not defined for this answer.
    """
    if math.isinf(value) or (math.isnan(value) and overflowed):
        why = ": numbers overflowed" if overflowed else ""
        raise ValueError(f"{name} is {value}{why}; expected a finite score, or NaN for undefined")


def _provenance(job: Job, config: WorkerConfig) -> dict[str, str]:
    digests = {f"digest of {uri}": digest for uri, digest in job.digests.items()}
    return {**config.provenance, **digests}
