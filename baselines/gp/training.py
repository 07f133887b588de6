"""Type-II maximum likelihood (thesis §4.2) by L-BFGS-B, from several starts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import Bounds, minimize

from mocapbench.baselines.gp.parameters import Parameters
from mocapbench.baselines.gp.solver import SingularCovarianceError

__all__ = ["Search", "Training", "maximise"]

Array = NDArray[np.float64]

Likelihood = Callable[[Parameters], tuple[float, Array]]
"""From parameters to the log-likelihood and its gradient in the free coordinates."""

TOLERANCE = 1e-7
"""Relative gain of the log-likelihood per iteration at which a search ends."""
MEMORY = 50
"""Steps that L-BFGS-B remembers: on walking, half the evaluations of its default 10."""


@dataclass(frozen=True, eq=False)
class Search:
    """The outcome of one start.

    Parameters
    ----------
    parameters : Parameters
        The best point found.
    log_likelihood : float
        The log-likelihood there.
    n_evaluations, n_iterations : int
        What it took.
    converged : bool
        Whether the search ended by its own tolerance.
    message : str
        Why it ended.
    """

    parameters: Parameters
    log_likelihood: float
    n_evaluations: int
    n_iterations: int
    converged: bool
    message: str


@dataclass(frozen=True, eq=False)
class Training:
    """The outcome of all starts, in order.

    Parameters
    ----------
    searches : tuple of Search
        One for each start.
    """

    searches: tuple[Search, ...]

    @property
    def best(self) -> Search:
        """The search with the highest likelihood."""
        return max(self.searches, key=lambda search: search.log_likelihood)


def maximise(
    likelihood: Likelihood,
    starts: Sequence[Parameters],
    limits: tuple[Array, Array],
    max_iter: int,
) -> Training:
    """Search for the maximum from every start.

    Parameters
    ----------
    likelihood : callable
        The function to maximise.
    starts : sequence of Parameters
        Where to begin; moved inside the limits.
    limits : tuple of two ndarrays of shape (n_parameters,)
        Lower and upper bounds of the free coordinates.
    max_iter : int
        Largest number of iterations of each search.

    Raises
    ------
    SingularCovarianceError
        If the covariance is singular at a start.
    """
    return Training(tuple(_search(likelihood, start, limits, max_iter) for start in starts))


class _Objective:
    """The negative log-likelihood of a flat vector, which remembers its best point."""

    def __init__(self, likelihood: Likelihood, space: Parameters) -> None:
        self.likelihood, self.space = likelihood, space
        self.best, self.best_value = space, np.inf
        self.n_evaluations = 0

    def __call__(self, flat: Array) -> tuple[float, Array]:
        self.n_evaluations += 1
        parameters = self.space.at(flat)
        value, gradient = self.likelihood(parameters)
        if -value < self.best_value:
            self.best, self.best_value = parameters, -value
        return -value, -gradient


def _search(
    likelihood: Likelihood, start: Parameters, limits: tuple[Array, Array], max_iter: int
) -> Search:
    """Run L-BFGS-B.

    A covariance that turns singular ends a line search for good: no finite value would be true
    there, and an infinite one ruins the interpolation. The search then begins anew, with an empty
    memory and hence a short first step, at the best point so far, as long as that improves.
    """
    objective = _Objective(likelihood, start)
    flat, n_iterations = np.clip(start.flat, *limits), 0
    while True:
        try:
            result = minimize(
                objective,
                flat,
                jac=True,
                method="L-BFGS-B",
                bounds=Bounds(*limits),
                options={
                    "maxiter": max_iter,
                    "maxfun": 2 * max_iter,
                    "ftol": TOLERANCE,
                    "maxcor": MEMORY,
                },
            )
        except SingularCovarianceError as error:
            if np.isinf(objective.best_value):
                raise
            ended = (False, str(error))
            if not np.array_equal(objective.best.flat, flat):
                flat = objective.best.flat
                continue
        else:
            n_iterations += int(result.nit)
            ended = (bool(result.success), str(result.message))
        return Search(
            objective.best, -objective.best_value, objective.n_evaluations, n_iterations, *ended
        )
