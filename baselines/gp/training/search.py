"""The values that a search takes and gives: where, for how long, and with what result."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import Bounds

from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.training.coordinates import Coordinates

__all__ = ["Budget", "Iteration", "Likelihood", "Report", "Search", "SearchSpace", "Training"]

Likelihood = Callable[[Parameters], tuple[float, NDArray[np.float64]]]
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


@dataclass(frozen=True, eq=False)
class SearchSpace:
    """Where to search.

    Parameters
    ----------
    coordinates : Coordinates
        The coordinates in which the search moves.
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


class Iteration(NamedTuple):
    """The state of a search after an iteration, with evaluations and seconds since it began."""

    iteration: int
    log_likelihood: float
    n_evaluations: int
    seconds: float


Report = Callable[[int, Iteration], None]
"""Called after every iteration with the index of the search."""


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
    trace : tuple of Iteration
        Every iteration, with the best log-likelihood so far.
    converged : bool
        Whether the search ended because its tolerance was met.
    message : str
        Why it ended.
    """

    parameters: Parameters
    log_likelihood: float
    n_evaluations: int
    trace: tuple[Iteration, ...]
    converged: bool
    message: str

    @property
    def n_iterations(self) -> int:
        """The number of iterations."""
        return len(self.trace)


@dataclass(frozen=True, eq=False)
class Training:
    """The results of all searches, in order.

    Parameters
    ----------
    searches : tuple of Search
        One for each start, except those that there was no time left for.
    """

    searches: tuple[Search, ...]

    @property
    def best(self) -> Search:
        """The search with the highest likelihood."""
        return max(self.searches, key=lambda search: search.log_likelihood)
