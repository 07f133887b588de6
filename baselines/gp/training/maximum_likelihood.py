"""Type-II maximum likelihood by L-BFGS-B, from several starts.

This is the training of §4.2 of J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes
for Human Motion Data*, MSc thesis, Universidad Tecnológica de Pereira, 2017;
docs/mathematics/prediction.md, section 10, has the details.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from time import perf_counter

import numpy as np
from scipy.optimize import Bounds, minimize

from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.solvers.solver import SingularCovarianceError
from mocapbench.baselines.gp.training.coordinates import Coordinates
from mocapbench.basics.arrays import Array

__all__ = ["Budget", "Likelihood", "Report", "Search", "maximise"]


MEMORY = 200
"""Steps that L-BFGS-B remembers, if there are as many parameters. On walking this takes a third of
the evaluations of its default of 10, for 2 ms an iteration."""

MAX_LINE_SEARCH = 20
"""Largest number of evaluations of an iteration, scipy's default."""


Likelihood = Callable[[Parameters], tuple[float, Array]]
"""From parameters to the log-likelihood and its gradient in the free coordinates."""


@dataclass(frozen=True)
class Budget:
    """When to stop.

    Parameters
    ----------
    tol : float
        A search has converged when an iteration gains less than this fraction of the
        log-likelihood's absolute value (or of 1, if that is larger).
    max_iter : int
        Largest number of iterations of one search. Most take one evaluation, none above 20.
    max_seconds : float or None
        Time for all searches together in seconds; None sets no limit. It is checked before every
        evaluation but the first.
    """

    tol: float
    max_iter: int
    max_seconds: float | None


Report = Callable[[int, int, float, float], None]
"""Called after every iteration with the index of the search, the number of its iterations, the best
log-likelihood so far, and the seconds since the search began."""


@dataclass(frozen=True, eq=False)
class Search:
    """The result of one search.

    Parameters
    ----------
    parameters : Parameters
        The best parameters evaluated.
    log_likelihood : float
        The log-likelihood there.
    n_evaluations : int
        The number of evaluations.
    n_iterations : int
        The number of iterations.
    converged : bool
        Whether the search ended because its tolerance was met.
    message : str
        Why it ended.
    """

    parameters: Parameters
    log_likelihood: float
    n_evaluations: int
    n_iterations: int
    converged: bool
    message: str


def maximise(
    likelihood: Likelihood,
    starts: Sequence[Parameters],
    coordinates: Coordinates,
    budget: Budget,
    report: Report,
) -> tuple[Search, ...]:
    """Search for the maximum from every start, until the time is spent.

    Parameters
    ----------
    likelihood : callable
        The function to maximise.
    starts : sequence of Parameters
        Where to begin; moved inside the bounds.
    coordinates : Coordinates
        In which to search, within their bounds.
    budget : Budget
        When to stop.
    report : callable
        Called after every iteration.

    Returns
    -------
    tuple of Search
        One for each start, except those that there was no time left for.

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
        objective = _Objective(likelihood, coordinates, deadline, partial(report, index))
        searches.append(_search(objective, coordinates.of(start), coordinates.bounds, budget))
    return tuple(searches)


class _OutOfTime(Exception):  # noqa: N818
    """The deadline has passed."""


class _Objective:
    """The negative log-likelihood of a vector of coordinates, with a record of the search."""

    def __init__(
        self,
        likelihood: Likelihood,
        coordinates: Coordinates,
        deadline: float,
        report: Callable[[int, float, float], None],
    ) -> None:
        self.likelihood, self.coordinates = likelihood, coordinates
        self.deadline, self.report = deadline, report
        self.best, self.best_value = np.empty(0), -np.inf
        self.begun, self.n_evaluations, self.n_iterations = perf_counter(), 0, 0

    def __call__(self, point: Array) -> tuple[float, Array]:
        if self.n_evaluations and perf_counter() > self.deadline:
            raise _OutOfTime
        self.n_evaluations += 1
        value, gradient = self.likelihood(self.coordinates.at(point))
        if value > self.best_value:
            self.best, self.best_value = point.copy(), value
        return -value, -self.coordinates.pull_back(point, gradient)

    def end_iteration(self, xk: Array) -> None:  # noqa: ARG002
        """Count and report an iteration; scipy asks for the argument ``xk``."""
        self.n_iterations += 1
        self.report(self.n_iterations, self.best_value, perf_counter() - self.begun)

    def end(self, converged: bool, message: str) -> Search:
        """Return the result of the search."""
        return Search(
            self.coordinates.at(self.best),
            self.best_value,
            self.n_evaluations,
            self.n_iterations,
            converged,
            str(message),
        )


def _search(objective: _Objective, start: Array, bounds: Bounds, budget: Budget) -> Search:
    """Run L-BFGS-B.

    A line search cannot continue where the covariance is singular: any finite value there would be
    false, and an infinite one ruins the interpolation. The search then restarts from the best
    point so far with an empty memory, and hence a short first step, as long as that improves.
    """
    begin = np.clip(start, bounds.lb, bounds.ub)
    while True:
        try:
            result = minimize(
                objective,
                begin,
                jac=True,
                method="L-BFGS-B",
                bounds=bounds,
                callback=objective.end_iteration,
                options={
                    "maxiter": budget.max_iter - objective.n_iterations,
                    "maxfun": MAX_LINE_SEARCH * budget.max_iter,
                    "maxls": MAX_LINE_SEARCH,
                    "ftol": budget.tol,
                    "maxcor": min(MEMORY, len(begin)),
                },
            )
        except _OutOfTime:
            return objective.end(False, "the budget of max_seconds is spent")
        except SingularCovarianceError as error:
            if np.isinf(objective.best_value):
                raise
            if np.array_equal(objective.best, begin):
                return objective.end(False, str(error))
            begin = objective.best
        else:
            return objective.end(bool(result.success), result.message)
