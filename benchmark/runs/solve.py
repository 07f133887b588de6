"""Fitting one entrant to one problem, with the clock and the memory watched."""

from __future__ import annotations

import resource
import time
import warnings
from collections.abc import Mapping
from typing import Any

from mocapbench.baselines import Model
from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.problems.internals import disclosed
from mocapbench.benchmark.registry import MODELS
from mocapbench.benchmark.runs.job import Job
from mocapbench.benchmark.runs.store import Fit

__all__ = ["build_model", "solve"]

MIB = 2**20


def build_model(name: str, parameters: Mapping[str, Any], random_state: int) -> Model:
    """Return an unfitted model, seeded if it takes a seed."""
    model = MODELS.get(name)(**parameters)
    if "random_state" in model.get_params():
        model.set_params(random_state=random_state)
    return model


def solve(job: Job, problem: Problem) -> Fit:
    """Return the entrant's solution of ``problem`` and what it cost."""
    model = build_model(job.model, job.parameters, job.seeds.random_state("init", job.label))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        started = time.perf_counter()
        problem.fit(model)
        fitted = time.perf_counter()
        solution = problem.solve(model, job.seeds.random_state("sample", job.label))
        done = time.perf_counter()
        told = disclosed(model, problem.train)
    iterations, converged = (
        getattr(model, f"{name}_", None) for name in ("n_iterations", "converged")
    )
    return Fit(
        {**solution, **told},
        fit_seconds=fitted - started,
        predict_seconds=done - fitted,
        peak_memory_mb=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / MIB,
        iterations=None if iterations is None else int(iterations),
        converged=None if converged is None else bool(converged),
        engine=str(getattr(model, "engine_", "")),
        warnings=tuple(dict.fromkeys(str(warning.message) for warning in caught)),
    )
