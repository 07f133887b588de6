"""Variational expectation–maximisation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from mocapbench.baselines.alignment.bound import bound
from mocapbench.baselines.alignment.model import Hyperparameters, State
from mocapbench.baselines.alignment.sequences import Sequences

__all__ = ["Objective", "Run", "Update", "expectation_maximisation"]

Objective = Callable[[State, Sequences, Hyperparameters], float]
Update = Callable[[State, Sequences, Hyperparameters], State]


@dataclass(frozen=True)
class Run:
    """The result of EM.

    Parameters
    ----------
    state : State
        The final state.
    bounds : tuple of float
        The objective at the start and after each iteration.
    converged : bool
        Whether the last iteration raised the objective by less than the tolerance.
    """

    state: State
    bounds: tuple[float, ...]
    converged: bool


def expectation_maximisation(
    state: State,
    sequences: Sequences,
    hyper: Hyperparameters,
    *,
    e_step: Sequence[Update],
    m_step: Sequence[Update],
    n_inner: int,
    max_iter: int,
    tolerance: float,
    objective: Objective = bound,
) -> Run:
    """Alternate ``n_inner`` sweeps of the E-step with one of the M-step.

    Stops when the objective rises by less than ``tolerance`` per visible entry, and after
    ``max_iter`` iterations at the latest.
    """
    bounds = [objective(state, sequences, hyper)]
    threshold = tolerance * sequences.counts.sum()
    for _ in range(max_iter):
        for update in (*e_step,) * n_inner + (*m_step,):
            state = update(state, sequences, hyper)
        bounds.append(objective(state, sequences, hyper))
        if bounds[-1] - bounds[-2] < threshold:
            return Run(state, tuple(bounds), converged=True)
    return Run(state, tuple(bounds), converged=False)
