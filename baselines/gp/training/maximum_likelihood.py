"""Type-II maximum likelihood (thesis §4.2) by L-BFGS-B, from several starts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from time import perf_counter
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import Bounds, minimize

from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.solver import SingularCovarianceError
from mocapbench.baselines.gp.training.coordinates import Coordinates

__all__ = ["Budget", "Search", "Space", "Step", "Training", "maximise"]

Array = NDArray[np.float64]

Likelihood = Callable[[Parameters], tuple[float, Array]]
"""From parameters to the log-likelihood and its gradient in the free coordinates."""

MEMORY = 200
"""Steps that L-BFGS-B remembers, if there are as many parameters: on walking a third of the
evaluations of its default 10, for 2 ms an iteration."""

MAX_LINE_SEARCH = 20
"""Evaluations that an iteration may take, scipy's default."""


@dataclass(frozen=True)
class Budget:
    """When to stop.

    Parameters
    ----------
    tol : float
        A search has converged when an iteration gains less than this share of the
        log-likelihood's size (or of 1, if that is larger).
    max_iter : int
        Largest number of iterations of one search. Most take one evaluation, none above 20.
    max_seconds : float or None
        Time for all searches together, or None for as long as it takes. It is looked at before
        every evaluation but the first.
    """

    tol: float
    max_iter: int
    max_seconds: float | None


@dataclass(frozen=True, eq=False)
class Space:
    """Where to search.

    Parameters
    ----------
    coordinates : Coordinates
        The coordinates that the search moves in.
    lower, upper : Parameters
        Bounds of the parameters.
    """

    coordinates: Coordinates
    lower: Parameters
    upper: Parameters

    @property
    def bounds(self) -> Bounds:
        """The bounds of the coordinates."""
        return Bounds(self.coordinates.of(self.lower), self.coordinates.of(self.upper))


class Step(NamedTuple):
    """The end of an iteration: evaluations and seconds are those since the search began."""

    iteration: int
    log_likelihood: float
    n_evaluations: int
    seconds: float


Report = Callable[[int, Step], None]
"""Takes the index of a search and its newest step."""


@dataclass(frozen=True, eq=False)
class Search:
    """The outcome of one start.

    Parameters
    ----------
    parameters : Parameters
        The best point found.
    log_likelihood : float
        The log-likelihood there.
    n_evaluations : int
        What it took.
    trace : tuple of Step
        Every iteration, with the best log-likelihood so far.
    converged : bool
        Whether the search ended by its own tolerance.
    message : str
        Why it ended.
    """

    parameters: Parameters
    log_likelihood: float
    n_evaluations: int
    trace: tuple[Step, ...]
    converged: bool
    message: str

    @property
    def n_iterations(self) -> int:
        """The number of iterations."""
        return len(self.trace)


@dataclass(frozen=True, eq=False)
class Training:
    """The outcome of all searches, in order.

    Parameters
    ----------
    searches : tuple of Search
        One for each start that the time sufficed for.
    """

    searches: tuple[Search, ...]

    @property
    def best(self) -> Search:
        """The search with the highest likelihood."""
        return max(self.searches, key=lambda search: search.log_likelihood)


def maximise(
    likelihood: Likelihood,
    starts: Sequence[Parameters],
    space: Space,
    budget: Budget,
    report: Report,
) -> Training:
    """Search for the maximum from every start, until the time is spent.

    Parameters
    ----------
    likelihood : callable
        The function to maximise.
    starts : sequence of Parameters
        Where to begin; moved inside the limits.
    space : Space
        Where to search.
    budget : Budget
        When to stop.
    report : callable
        Called after every iteration with the index of the start and the `Step`.

    Raises
    ------
    SingularCovarianceError
        If the covariance is singular at a start.
    """
    deadline = np.inf if budget.max_seconds is None else perf_counter() + budget.max_seconds
    searches: list[Search] = []
    for index, start in enumerate(starts):
        if index and perf_counter() > deadline:
            break
        climb = _Climb(likelihood, space.coordinates, deadline, partial(report, index))
        searches.append(_search(climb, space.coordinates.of(start), space.bounds, budget))
    return Training(tuple(searches))


class _OutOfTime(Exception):  # noqa: N818
    """The deadline is over."""


class _Climb:
    """The negative log-likelihood of a vector, which remembers its best point and counts."""

    def __init__(
        self,
        likelihood: Likelihood,
        coordinates: Coordinates,
        deadline: float,
        report: Callable[[Step], None],
    ) -> None:
        self.likelihood, self.coordinates = likelihood, coordinates
        self.deadline, self.report = deadline, report
        self.best, self.best_value = np.empty(0), -np.inf
        self.begun, self.n_evaluations = perf_counter(), 0
        self.trace: list[Step] = []

    def __call__(self, point: Array) -> tuple[float, Array]:
        if self.n_evaluations and perf_counter() > self.deadline:
            raise _OutOfTime
        self.n_evaluations += 1
        value, gradient = self.likelihood(self.coordinates.at(point))
        if value > self.best_value:
            self.best, self.best_value = point.copy(), value
        return -value, -self.coordinates.pull_back(point, gradient)

    def end_iteration(self, xk: Array) -> None:  # noqa: ARG002
        """Note where the search stands."""
        seconds = perf_counter() - self.begun
        step = Step(len(self.trace) + 1, self.best_value, self.n_evaluations, seconds)
        self.trace.append(step)
        self.report(step)

    def end(self, converged: bool, message: str) -> Search:
        """Return the outcome."""
        return Search(
            self.coordinates.at(self.best),
            self.best_value,
            self.n_evaluations,
            tuple(self.trace),
            converged,
            str(message),
        )


def _search(climb: _Climb, start: Array, bounds: Bounds, budget: Budget) -> Search:
    """Run L-BFGS-B.

    A covariance that turns singular ends a line search for good: no finite value would be true
    there, and an infinite one ruins the interpolation. The search then goes on from the best point
    so far with an empty memory, and hence a short first step, as long as that improves.
    """
    begin = np.clip(start, bounds.lb, bounds.ub)
    while True:
        try:
            result = minimize(
                climb,
                begin,
                jac=True,
                method="L-BFGS-B",
                bounds=bounds,
                callback=climb.end_iteration,
                options={
                    "maxiter": budget.max_iter - len(climb.trace),
                    "maxfun": MAX_LINE_SEARCH * budget.max_iter,
                    "maxls": MAX_LINE_SEARCH,
                    "ftol": budget.tol,
                    "maxcor": min(MEMORY, len(begin)),
                },
            )
        except _OutOfTime:
            return climb.end(False, "the budget of max_seconds is spent")
        except SingularCovarianceError as error:
            if np.isinf(climb.best_value):
                raise
            if np.array_equal(climb.best, begin):
                return climb.end(False, str(error))
            begin = climb.best
        else:
            return climb.end(bool(result.success), result.message)
