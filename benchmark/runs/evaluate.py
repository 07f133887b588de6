"""Evaluation of one job, in the worker process that runs it."""

from __future__ import annotations

import resource
import traceback
from dataclasses import asdict
from typing import Any

from joblib import parallel_config
from threadpoolctl import threadpool_limits

from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.plugins import load_plugin
from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS
from mocapbench.benchmark.runs.fit import Fit
from mocapbench.benchmark.runs.job import Job, WorkerConfig
from mocapbench.benchmark.runs.record import Record, Status
from mocapbench.benchmark.runs.solve import solve
from mocapbench.benchmark.runs.store import Store

__all__ = ["evaluate"]


def evaluate(job: Job, config: WorkerConfig) -> Record:
    """Return the record of ``job``; whatever the model raises becomes a failed record.

    The predictions are kept in the store, and taken from there if they exist already.
    """
    try:
        resource.setrlimit(resource.RLIMIT_AS, (config.memory, resource.RLIM_INFINITY))
        # One BLAS thread, so that results do not depend on how many jobs run at once.
        with threadpool_limits(1), parallel_config("threading", n_jobs=config.threads):
            return _evaluate(job, config)
    except MemoryError:
        limit = config.memory / 2**30
        message = f"the job needed more than its {limit:.1f} GiB; raise --memory or lower --jobs"
        return job.record(Status.OUT_OF_MEMORY, message, traceback=traceback.format_exc())
    except BaseException as error:  # a model that calls sys.exit has failed like any other
        message = f"{type(error).__name__}: {error}"
        return job.record(Status.FAILED, message, traceback=traceback.format_exc())


def _evaluate(job: Job, config: WorkerConfig) -> Record:
    for path in config.plugins:
        load_plugin(path)
    case = TASKS.get(job.address.task).case(job.address.case)
    problem = case.problem(job.seeds, archive_at(config.data_dir))
    store = Store(config.out)
    fit = store.load_fit(job.fit_key)
    if fit is None:
        fit = solve(problem, MODELS.get(job.model), job.parameters, job.seeds)
        store.save_fit(job.fit_key, fit)
    costs = {name: value for name, value in asdict(fit).items() if name != "arrays"}
    costs["warnings"] = (*fit.warnings, *store.damaged)
    results = {**costs, **_scores(job, problem, fit), "provenance": _provenance(job, config)}
    return job.record(Status.OK, **results)


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
