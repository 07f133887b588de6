"""Steps that raise an objective, repeated until one raises it too little."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

__all__ = ["Ascent", "ascend"]

State = TypeVar("State")


@dataclass(frozen=True)
class Ascent(Generic[State]):
    """Where an ascent ended, and its course.

    Parameters
    ----------
    state : object
        The final state.
    objectives : tuple of float
        The objective at the start and after each iteration.
    converged : bool
        Whether the last iteration raised it by less than the threshold.
    """

    state: State
    objectives: tuple[float, ...]
    converged: bool

    @property
    def n_iterations(self) -> int:
        """The number of iterations."""
        return len(self.objectives) - 1


def ascend(
    state: State,
    step: Callable[[State], State],
    objective: Callable[[State], float],
    *,
    max_iter: int,
    threshold: float,
) -> Ascent[State]:
    """Take steps from a state until one raises the objective by less than the threshold.

    Parameters
    ----------
    state : object
        Where to start.
    step : callable
        From a state to a better one.
    objective : callable
        From a state to what is to be raised.
    max_iter : int
        The largest number of steps.
    threshold : float
        The least rise.

    Examples
    --------
    >>> ascend(1.0, lambda x: x / 2, lambda x: -(x**2), max_iter=9, threshold=0.1)
    Ascent(state=0.125, objectives=(-1.0, -0.25, -0.0625, -0.015625), converged=True)
    """
    objectives = [objective(state)]
    for _ in range(max_iter):
        state = step(state)
        objectives.append(objective(state))
        if objectives[-1] - objectives[-2] < threshold:
            return Ascent(state, tuple(objectives), converged=True)
    return Ascent(state, tuple(objectives), converged=False)
