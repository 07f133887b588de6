"""Fitting one entrant to one problem and asking it, while time and memory are measured."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple, Self

from mocapbench.basics.system.choice import find_system
from mocapbench.benchmark.problems.arrays import Arrays
from mocapbench.benchmark.problems.base import Problem
from mocapbench.benchmark.problems.internals import internals_of
from mocapbench.benchmark.runs.fitting.fit import Fit

if TYPE_CHECKING:
    from mocapbench.baselines import Model

__all__ = ["FitCosts", "Fitted", "build_model", "solve", "train"]

MIB = 2**20


class FitCosts(NamedTuple):
    """What a fit cost, and the warnings that the model raised in it."""

    seconds: float
    peak_memory_mb: float
    warnings: tuple[str, ...]


class Fitted(NamedTuple):
    """A fitted model, and what its fit cost."""

    model: Model
    costs: FitCosts
    internals: Arrays | None = None
    """What `internals_of` returns, where it is known."""

    def with_internals(self, problem: Problem[Any]) -> Self:
        """Return the same with internals; to compute them may change the model's state."""
        if self.internals is not None:
            return self
        with _warnings() as caught:
            internals = internals_of(self.model, problem.train)
        costs = self.costs._replace(warnings=(*self.costs.warnings, *_texts(caught)))
        return self._replace(costs=costs, internals=internals)


def build_model(
    model: type[Model],
    parameters: Mapping[str, Any],
    random_state: int,
    calibration: Callable[[Any], Model] | None,
) -> Model:
    """Return an unfitted model, seeded if it takes a seed, in its calibration if it has one."""
    built = model(**parameters)
    if "random_state" in built.get_params():
        built.set_params(random_state=random_state)
    return built if calibration is None else calibration(built)


def train(
    problem: Problem[Any],
    entrant: type[Model],
    parameters: Mapping[str, Any],
    random_state: int,
    calibration: Callable[[Any], Model] | None = None,
) -> Fitted:
    """Return the entrant, fitted to what ``problem`` lets it see.

    Parameters
    ----------
    problem : Problem
    entrant, parameters : type, mapping
        The class of the model, and its parameters.
    random_state : int
        The seed of the fit.
    calibration : callable, optional
        From the model to one with calibrated variances.
    """
    model = build_model(entrant, parameters, random_state, calibration)
    with _warnings() as caught:
        started = time.perf_counter()
        problem.fit(model)
        seconds = time.perf_counter() - started
    return Fitted(model, FitCosts(seconds, _peak_memory_mb(), _texts(caught)))


def solve(problem: Problem[Any], fitted: Fitted, random_state: int) -> Fit:
    """Return a fitted model's solution to ``problem``, and what it cost with the fit.

    Parameters
    ----------
    problem : Problem
    fitted : Fitted
        A model fitted to the training recordings of the problem.
    random_state : int
        The seed of what it draws.
    """
    model = fitted.model
    with _warnings() as caught:
        started = time.perf_counter()
        solution = problem.solve(model, random_state)
        seconds = time.perf_counter() - started
    _, costs, internals = fitted.with_internals(problem)
    iterations, converged = (
        getattr(model, f"{name}_", None) for name in ("n_iterations", "converged")
    )
    return Fit(
        {**problem.to_arrays(solution), **(internals or {})},
        fit_seconds=costs.seconds,
        predict_seconds=seconds,
        peak_memory_mb=max(costs.peak_memory_mb, _peak_memory_mb()),
        iterations=None if iterations is None else int(iterations),
        converged=None if converged is None else bool(converged),
        engine=str(getattr(model, "engine_", "")),
        warnings=tuple(dict.fromkeys((*costs.warnings, *_texts(caught)))),
    )


@contextmanager
def _warnings() -> Iterator[list[warnings.WarningMessage]]:
    """Collect all warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield caught


def _texts(caught: list[warnings.WarningMessage]) -> tuple[str, ...]:
    return tuple(str(warning.message) for warning in caught)


def _peak_memory_mb() -> float:
    """Return the peak of this process, or of a program that it has run if that is higher."""
    return find_system().measure_peak() / MIB
