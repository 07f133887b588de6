"""Evaluation of one job: pose its problem, fit, answer and score."""

from __future__ import annotations

import resource
import traceback
from typing import Any, NamedTuple

from joblib import parallel_config

from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS
from mocapbench.benchmark.runs.fitting.fit import Fit
from mocapbench.benchmark.runs.fitting.solve import Fitted, solve, train
from mocapbench.benchmark.runs.fitting.trained import Trained
from mocapbench.benchmark.runs.job import Job, Work, WorkerConfig
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.datasets import Archive

__all__ = ["Evaluation", "evaluate"]


class Evaluation(NamedTuple):
    """What became of a job, and what of it is new."""

    record: Record
    fit: Fit | None = None
    """The predictions."""
    trained: Trained | None = None
    """The fitted model, where other jobs can use it."""


def evaluate(work: Work, config: WorkerConfig, archive: Archive) -> Evaluation:
    """Return the record of a job, and what others can use of it.

    Whatever the model raises becomes a failed record. The process's memory is limited from now on.

    Parameters
    ----------
    work : Work
    config : WorkerConfig
    archive : Archive
        Where recordings come from.
    """
    job, fit, new, trained = work.job, work.fit, None, None
    try:
        resource.setrlimit(resource.RLIMIT_AS, (config.memory, resource.RLIM_INFINITY))
        problem = TASKS.get(job.address.task).case(job.address.case).problem(job.seeds, archive)
        if fit is None:
            with parallel_config("threading", n_jobs=config.threads):
                fitted, trained = _fitted(work, problem)
                fit = new = solve(problem, fitted, job.seeds.random_state("sample"))
        return Evaluation(_scored(work, fit, problem, config), new, trained)
    except MemoryError:
        limit = config.memory / 2**30
        message = f"the job needed more than its {limit:.1f} GiB; raise --memory or lower --jobs"
        record = job.record(Status.OUT_OF_MEMORY, message, traceback=traceback.format_exc())
    except BaseException as error:  # a model that calls sys.exit has failed like any other
        message = f"{type(error).__name__}: {error}"
        record = job.record(Status.FAILED, message, traceback=traceback.format_exc())
    return Evaluation(record, new, trained)


def _fitted(work: Work, problem: Problem[Any]) -> tuple[Fitted, Trained | None]:
    """Return the fitted model, and the same for other jobs if it is new and they can use it."""
    job, trained = work.job, work.trained
    if trained is not None and trained.suits(problem):
        return trained.load(), None
    random_state = job.training_seeds.random_state("init")
    fitted = train(problem, MODELS.get(job.model), job.parameters, random_state)
    new = Trained.of(job.training_key, fitted, problem) if job.training_key else None
    # Loaded here too: what went through pickle may differ in memory layout, and so in rounding.
    return (new.load() if new else fitted), new


def _scored(work: Work, fit: Fit, problem: Problem[Any], config: WorkerConfig) -> Record:
    costs = {**fit.costs, "warnings": (*fit.warnings, *work.remarks)}
    results = {**costs, **_scores(work.job, problem, fit)}
    return work.job.record(Status.OK, **results, provenance=_provenance(work.job, config))


def _scores(job: Job, problem: Problem[Any], fit: Fit) -> dict[str, Any]:
    """Score by every metric that is defined for this outcome."""
    outcome = problem.outcome(problem.answer_type.from_arrays(fit.arrays))
    metrics = [METRICS.get(name) for name in job.metrics]
    scores = {metric.name: metric(outcome) for metric in metrics if metric.applies(outcome)}
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


def _provenance(job: Job, config: WorkerConfig) -> dict[str, str]:
    digests = {f"digest of {uri}": digest for uri, digest in job.digests.items()}
    return {**config.provenance, **digests}
