"""Variational expectation–maximisation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from mocapbench.baselines.alignment.bound import bound
from mocapbench.baselines.alignment.model import Hyperparameters, State
from mocapbench.baselines.alignment.sequences import Sequences

__all__ = ["Run", "Update", "expectation_maximisation"]

Update = Callable[[State, Sequences, Hyperparameters], State]


@dataclass(frozen=True)
class Run:
    """What EM came to.

    Parameters
    ----------
    state : State
    bounds : tuple of float
        The bound after each iteration.
    converged : bool
        Whether the last iteration raised it by less than the tolerance.
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
) -> Run:
    """Repeat ``n_inner`` sweeps of the E-step and one of the M-step.

    Until the bound rises by less than ``tolerance`` per visible entry, or ``max_iter`` times.
    """
    bounds: list[float] = []
    threshold = tolerance * sequences.counts.sum()
    for _ in range(max_iter):
        for update in (*e_step,) * n_inner + (*m_step,):
            state = update(state, sequences, hyper)
        bounds.append(bound(state, sequences, hyper))
        if len(bounds) > 1 and bounds[-1] - bounds[-2] < threshold:
            return Run(state, tuple(bounds), converged=True)
    return Run(state, tuple(bounds), converged=False)
