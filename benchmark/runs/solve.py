"""Fitting one entrant to one problem, while time and memory are measured."""

from __future__ import annotations

import resource
import time
import warnings
from collections.abc import Mapping
from typing import Any

from mocapbench.baselines import Model
from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.problems.internals import internals_of
from mocapbench.benchmark.runs.fit import Fit
from mocapbench.benchmark.tasks.seeds import Seeds

__all__ = ["build_model", "solve"]

MIB = 2**20


def build_model(model: type[Model], parameters: Mapping[str, Any], random_state: int) -> Model:
    """Return an unfitted model, seeded if it takes a seed."""
    built = model(**parameters)
    if "random_state" in built.get_params():
        built.set_params(random_state=random_state)
    return built


def solve(
    problem: Problem[Any], entrant: type[Model], parameters: Mapping[str, Any], seeds: Seeds
) -> Fit:
    """Return the entrant's answer to ``problem`` and what it cost.

    Parameters
    ----------
    problem : Problem
    entrant, parameters : type, mapping
        The class of the model, and its parameters.
    seeds : Seeds
        The entrant's streams: ``init`` for the model, ``sample`` for what it draws.
    """
    model = build_model(entrant, parameters, seeds.random_state("init"))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        started = time.perf_counter()
        problem.fit(model)
        fitted = time.perf_counter()
        answer = problem.solve(model, seeds.random_state("sample"))
        done = time.perf_counter()
        internals = internals_of(model, problem.train)
    iterations, converged = (
        getattr(model, f"{name}_", None) for name in ("n_iterations", "converged")
    )
    return Fit(
        {**answer.to_arrays(), **internals.to_arrays()},
        fit_seconds=fitted - started,
        predict_seconds=done - fitted,
        peak_memory_mb=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / MIB,
        iterations=None if iterations is None else int(iterations),
        converged=None if converged is None else bool(converged),
        engine=str(getattr(model, "engine_", "")),
        warnings=tuple(dict.fromkeys(str(warning.message) for warning in caught)),
    )
