"""Evaluation of one job: pose its problem, fit, answer and score."""

from __future__ import annotations

import resource
import traceback
from typing import Any

from joblib import parallel_config

from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS
from mocapbench.benchmark.runs.fit import Fit
from mocapbench.benchmark.runs.job import Job, Work, WorkerConfig
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.runs.solve import solve
from mocapbench.datasets import Archive

__all__ = ["evaluate"]


def evaluate(work: Work, config: WorkerConfig, archive: Archive) -> tuple[Record, Fit | None]:
    """Return the record of a job, and its predictions if they are new.

    Whatever the model raises becomes a failed record. The process's memory is limited from now on.

    Parameters
    ----------
    work : Work
    config : WorkerConfig
    archive : Archive
        Where recordings come from.
    """
    job, fit, new = work.job, work.fit, None
    try:
        resource.setrlimit(resource.RLIMIT_AS, (config.memory, resource.RLIM_INFINITY))
        problem = TASKS.get(job.address.task).case(job.address.case).problem(job.seeds, archive)
        if fit is None:
            with parallel_config("threading", n_jobs=config.threads):
                fit = new = solve(problem, MODELS.get(job.model), job.parameters, job.seeds)
        return _scored(work, fit, problem, config), new
    except MemoryError:
        limit = config.memory / 2**30
        message = f"the job needed more than its {limit:.1f} GiB; raise --memory or lower --jobs"
        return job.record(Status.OUT_OF_MEMORY, message, traceback=traceback.format_exc()), new
    except BaseException as error:  # a model that calls sys.exit has failed like any other
        message = f"{type(error).__name__}: {error}"
        return job.record(Status.FAILED, message, traceback=traceback.format_exc()), new


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
