"""Variational expectation–maximisation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce

from mocapbench.baselines.alignment.bound import lower_bound
from mocapbench.baselines.alignment.model import Hyperparameters, State
from mocapbench.baselines.alignment.sequences import Sequences
from mocapbench.baselines.common.ascent import Ascent, ascend

__all__ = ["Objective", "Update", "expectation_maximisation"]

Objective = Callable[[State, Sequences, Hyperparameters], float]
Update = Callable[[State, Sequences, Hyperparameters], State]


def expectation_maximisation(
    state: State,
    sequences: Sequences,
    hyper: Hyperparameters,
    *,
    e_step: Sequence[Update],
    m_step: Sequence[Update],
    n_inner: int,
    max_iter: int,
    tol: float,
    objective: Objective = lower_bound,
) -> Ascent[State]:
    """Alternate ``n_inner`` sweeps of the E-step with one of the M-step.

    Stops when the objective rises by less than ``tol`` per visible entry, and after
    ``max_iter`` iterations at the latest.
    """
    updates = (*e_step,) * n_inner + (*m_step,)
    return ascend(
        state,
        lambda before: reduce(lambda now, update: update(now, sequences, hyper), updates, before),
        lambda now: objective(now, sequences, hyper),
        max_iter=max_iter,
        threshold=tol * sequences.counts.sum(),
    )
