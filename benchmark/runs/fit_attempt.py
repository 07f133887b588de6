"""A model's part of a job, in a process of its own: it is fitted or loaded, and predicts."""

from __future__ import annotations

from typing import Any, NamedTuple

from joblib import parallel_config

from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.registry import MODELS
from mocapbench.benchmark.runs.fitting.fit import Fit
from mocapbench.benchmark.runs.fitting.solve import Fitted, solve, train
from mocapbench.benchmark.runs.fitting.trained import Trained
from mocapbench.benchmark.runs.job import Work, WorkerConfig
from mocapbench.benchmark.runs.record import Record

__all__ = ["FitAttempt", "attempt_fit"]


class FitAttempt(NamedTuple):
    """What came of fitting a model and having it predict."""

    fit: Fit | None
    """The predictions."""
    trained: Trained | None = None
    """The fitted model, where other jobs can use it."""
    failure: Record | None = None
    """Why there are no predictions."""


def attempt_fit(work: Work, problem: Problem[Any], config: WorkerConfig) -> FitAttempt:
    """Return what the job's model predicts for ``problem``; whatever it raises is a failure.

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
        return FitAttempt(None, trained, work.job.record_failure(error, config.memory))
    return FitAttempt(fit, trained)


def _fit_model(work: Work, problem: Problem[Any]) -> tuple[Fitted, Trained | None]:
    """Return the fitted model, and the same for other jobs if it is new and they can use it."""
    job, trained = work.job, work.trained
    if trained is not None and trained.suits(problem):
        return trained.load(), None
    random_state = job.training_seeds.random_state("init")
    fitted = train(problem, MODELS.get(job.model), job.parameters, random_state)
    new = Trained.of(job.training_key, fitted, problem) if job.training_key else None
    # Loaded here too: what went through pickle may differ in memory layout, and so in rounding.
    return (new.load() if new else fitted), new
