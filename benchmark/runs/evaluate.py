"""Evaluation of one job: pose its problem, fit its model and have it predict, score the prediction.

The model's part may run in a process of its own. A metric that fails costs no other its score.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from joblib import parallel_config

from mocapbench.basics.system.choice import find_system
from mocapbench.basics.words import format_count
from mocapbench.benchmark.messages import reason, traceback_of
from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS, find_calibration
from mocapbench.benchmark.runs.fitting.fit import Fit
from mocapbench.benchmark.runs.fitting.solve import Fitted, solve, train
from mocapbench.benchmark.runs.fitting.trained import Trained
from mocapbench.benchmark.runs.job import Job, Outcome, Work, WorkerConfig
from mocapbench.benchmark.runs.posed import problem_digest
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.score_values import fault_of_score
from mocapbench.datasets import Archive
from mocapbench.metrics import Metric, Score

__all__ = ["evaluate", "score_by"]

Attempt = tuple[Fit | None, Trained | None, Record | None]
"""The predictions, the fitted model where other jobs can use it, or why there are none."""


def _call_here(function: Callable[..., Attempt], *arguments: Any) -> Attempt:
    return function(*arguments)


def evaluate(
    work: Work,
    config: WorkerConfig,
    archive: Archive,
    call: Callable[..., Attempt] = _call_here,
) -> Outcome:
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
        find_system().limit_memory(config.memory)
        problem = TASKS.get(job.address.task).case(job.address.case).problem(job.seeds, archive)
        # Before the fork, which then knows the digests of recordings, as do later jobs.
        posed = problem_digest(problem)
    except BaseException as error:
        return Outcome(job.record_failure(error, config.memory))
    if work.fit is not None:
        return Outcome(_record_scores(work, work.fit, problem, posed, config))
    fit, trained, failure = call(attempt_fit, work, problem, config)
    if fit is not None:
        return Outcome(_record_scores(work, fit, problem, posed, config), fit, trained)
    assert failure is not None
    return Outcome(failure, None, trained)


def attempt_fit(work: Work, problem: Problem[Any], config: WorkerConfig) -> Attempt:
    """Fit the job's model and have it predict; whatever it raises is a failure.

    Parameters
    ----------
    work : Work
    problem : Problem
        That of the job.
    config : WorkerConfig
    """
    trained = None
    try:
        with parallel_config("threading", n_jobs=config.threads):
            fitted, trained = _fit_model(work, problem)
            fit = solve(problem, fitted, work.job.seeds.random_state("sample"))
    except BaseException as error:  # a model that calls sys.exit has failed like any other
        return None, trained, work.job.record_failure(error, config.memory)
    return fit, trained, None


def _fit_model(work: Work, problem: Problem[Any]) -> tuple[Fitted, Trained | None]:
    """Return the fitted model, and the same for other jobs if it is new and they can use it."""
    job, trained = work.job, work.trained
    if trained is not None and trained.suits(problem):
        return trained.load(), None
    random_state = job.training_seeds.random_state("init")
    model, calibration = MODELS.get(job.model), find_calibration(job.model)
    fitted = train(problem, model, job.parameters, random_state, calibration)
    new = Trained.of(job.training_key, fitted, problem) if job.training_key else None
    # Loaded here too: what went through pickle may differ in memory layout, and so in rounding.
    return (new.load() if new else fitted), new


def _record_scores(
    work: Work, fit: Fit, problem: Problem[Any], posed: str, config: WorkerConfig
) -> Record:
    try:
        return _score_fit(work, fit, problem, posed, config)
    except BaseException as error:
        return work.job.record_failure(error, config.memory)


def _score_fit(
    work: Work, fit: Fit, problem: Problem[Any], posed: str, config: WorkerConfig
) -> Record:
    scores, errors = _score_by_each(work.job, problem, fit)
    digests = {f"digest of {uri}": digest for uri, digest in work.job.digests.items()}
    return work.job.record(
        Status.FAILED if errors else Status.OK,
        _explain_errors(errors, scores),
        traceback="\n".join(map(traceback_of, errors)),
        problem=posed,
        **{**fit.costs, "warnings": (*fit.warnings, *work.remarks)},
        **_keep_scores(scores),
        provenance={**config.provenance, **digests},
    )


def _score_by_each(
    job: Job, problem: Problem[Any], fit: Fit
) -> tuple[dict[str, Score], list[Exception]]:
    """Score the solution of ``fit`` by every metric of a job that is defined for it.

    Returns
    -------
    scores : dict of str to Score
        By the names of the metrics.
    errors : list of Exception
        Why others failed.

    Raises
    ------
    MemoryError
        If a metric needs more memory than there is.
    ValueError
        If no metric is defined for the solution.
    """
    outcome = problem.outcome(problem.from_arrays(fit.arrays))
    scores: dict[str, Score] = {}
    errors: list[Exception] = []
    for name in job.metrics:
        try:
            scores |= score_by(METRICS.get(name), outcome)
        except MemoryError:  # for `Job.record_failure`, which says what to do
            raise
        except Exception as error:
            errors.append(error)
    if not scores and not errors:
        raise ValueError(
            f"none of the metrics {', '.join(job.metrics)} is defined for the solution of "
            f"{job.address.label} to {job.address.task}; choose others with --metrics"
        )
    return scores, errors


def _explain_errors(errors: Sequence[Exception], scores: Mapping[str, Score]) -> str:
    """Return why metrics failed, and whether there are scores all the same; empty if none did."""
    reasons = "; ".join(map(reason, errors))
    kept = f" ({format_count(len(scores), 'other score')} kept)" if scores else ""
    return f"{reasons}{kept}" if reasons else ""


def _keep_scores(scores: Mapping[str, Score]) -> dict[str, Any]:
    """Return what a record keeps of the scores."""
    found = scores.items()
    return {
        "scores": {name: float(score.value) for name, score in found},
        "parts": {
            name: {axis: values.tolist() for axis, values in score.parts.items()}
            for name, score in found
        },
        "left_out": {name: score.left_out for name, score in found if score.left_out},
    }


def score_by(metric: Metric[Any], outcome: object) -> dict[str, Score]:
    """Return the score by the metric's name, or nothing where the metric is not defined.

    Raises
    ------
    RuntimeError
        If the metric raises something.
    ValueError
        If it returns no score, or an infinite one.
    """
    overflows: list[str] = []
    try:
        if not metric.applies(outcome):
            return {}
        with np.errstate(over="call", call=lambda kind, _: overflows.append(kind)):
            score: object = metric(outcome)
    except MemoryError:
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

    Any other NaN says that the metric is not defined for this solution.
    """
    if math.isinf(value) or (math.isnan(value) and overflowed):
        why = ": numbers overflowed" if overflowed else ""
        raise ValueError(f"{name} is {value}{why}; expected a finite score, or NaN for undefined")
