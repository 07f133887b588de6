"""Variational expectation–maximisation: the updates of HLM §3, one function each.

No update lowers the bound. Equation numbers are those of HLM. Where a printed formula is wrong, the
docstring gives the corrected one.

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import reduce

import numpy as np
from scipy.linalg import solve_circulant

from mocapbench.baselines.alignment.chain import forward_backward
from mocapbench.baselines.alignment.cycle_model import (
    Hyperparameters,
    Paths,
    State,
    distance,
    emission,
    log_likelihood,
    lower_bound,
    residuals,
    roughness,
)
from mocapbench.baselines.alignment.ring import solve_rings
from mocapbench.baselines.common.ascent import Ascent, ascend
from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.basics.arrays import Array

__all__ = [
    "Objective",
    "Update",
    "expectation_maximisation",
    "update_closeness",
    "update_cycles",
    "update_jumps",
    "update_labels",
    "update_parent",
    "update_paths",
    "update_precisions",
    "update_smoothness",
    "update_weights",
]

Objective = Callable[[State, Sequences, Hyperparameters], float]
Update = Callable[[State, Sequences, Hyperparameters], State]


def expectation_maximisation(
    state: State,
    sequences: Sequences,
    hyper: Hyperparameters,
    *,
    e_step: Sequence[Update],
    m_step: Sequence[Update],
    max_iter: int,
    objective: Objective = lower_bound,
) -> Ascent[State]:
    """Alternate ``hyper.n_inner`` sweeps of the E-step with one of the M-step.

    Stops when the objective rises by less than ``hyper.tol`` per visible entry, and after
    ``max_iter`` iterations at the latest.
    """
    updates = (*e_step,) * hyper.n_inner + (*m_step,)
    return ascend(
        state,
        lambda before: reduce(lambda now, update: update(now, sequences, hyper), updates, before),
        lambda now: objective(now, sequences, hyper),
        max_iter=max_iter,
        threshold=hyper.tol * sequences.counts.sum(),
    )


def update_paths(state: State, sequences: Sequences, _: Hyperparameters) -> State:
    """Update Q(π), eq. (7), by forward–backward on the expected log-likelihoods, eq. (10)."""
    expected = emission(sequences, state.cycles, state.precisions, state.labels)
    posterior = forward_backward(expected, state.jumps, sequences.frames)
    return replace(state, paths=Paths.of(sequences, posterior))


def update_labels(state: State, sequences: Sequences, _: Hyperparameters) -> State:
    """Update Q(l), eq. (11), over visible entries."""
    score = np.log(state.weights) + log_likelihood(state, sequences)
    # Less the maximum, which cancels, so that nothing overflows.
    score -= score.max(axis=1, keepdims=True)
    labels = np.exp(score)
    return replace(state, labels=labels / labels.sum(axis=1, keepdims=True))


def update_cycles(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Update Q(Z), eq. (9), corrected.

    The precision S of a channel has the diagonal 2λ_s + λ_z̄ + λ_f n_m, with n_m the expected number
    of visible entries of state m, and the mean is S⁻¹ (λ_z̄ z̄ + λ_f Σ γ x). HLM divides the sum by
    n_m and omits S⁻¹.
    """
    counts, sums = state.paths.by_style(state.labels)
    ground = state.closeness + state.precisions * counts
    right = _pull_of_parent(state.parent, state, hyper)[:, None] + state.precisions * sums
    return replace(state, cycles=solve_rings(state.smoothness, ground, right))


def update_parent(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Update z̄, eq. (17) with the missing bracket.

    It solves (Cλ_z̄ + 4η) z̄_m − 2η (z̄_{m−1} + z̄_{m+1}) = λ_z̄ Σ_c ⟨z_m^c⟩. For the centred prior the
    precision matrix of a cycle takes the place of λ_z̄.
    """
    n_states, n_styles, _ = state.cycles.mean.shape
    # The matrix of the system is circulant: its first column is what it makes of an impulse.
    impulse = np.eye(n_states)[0]
    column = n_styles * _pull_of_parent(impulse, state, hyper)
    column += 2.0 * hyper.regularisation * _curvature(impulse)
    right = _pull_of_parent(state.cycles.mean.sum(axis=1), state, hyper)
    return replace(state, parent=solve_circulant(column, right))


def update_smoothness(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Update λ_s: eq. (13) or its equivalent for the chosen prior."""
    n_states, *batch = state.cycles.mean.shape
    reference = hyper.prior.reference(state.parent)
    mean = roughness(state.cycles, reference) / np.prod(batch)
    best = hyper.prior.smoothness(state.closeness, n_states, mean)
    return replace(state, smoothness=best)


def update_closeness(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Update λ_z̄: eq. (12) or its equivalent for the chosen prior."""
    n_states, *batch = state.cycles.mean.shape
    mean = distance(state.cycles, state.parent) / np.prod(batch)
    best = hyper.prior.closeness(state.smoothness, n_states, mean)
    return replace(state, closeness=best)


def update_precisions(state: State, sequences: Sequences, hyper: Hyperparameters) -> State:
    """Update λ_f^c, eq. (14), over visible entries; a style without any keeps its precision."""
    # Entries over their expected squares, which are at least what the largest precision allows.
    counts = state.labels.T @ sequences.counts
    squares = np.einsum("kc,kcf->cf", state.labels, residuals(state, sequences))
    best = counts / np.maximum(squares, counts / hyper.max_precision + np.finfo(float).tiny)
    return replace(state, precisions=np.where(best > 0, best, state.precisions))


def update_weights(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Update τ, eq. (15)."""
    weights = hyper.regularisation + state.labels.sum(axis=0)
    return replace(state, weights=weights / weights.sum())


def update_jumps(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Update d, eq. (16), where ξ is the joint posterior of two consecutive states."""
    jumps = hyper.regularisation + state.paths.n_jumps
    return replace(state, jumps=jumps / jumps.sum(axis=1, keepdims=True))


def _pull_of_parent(curves: Array, state: State, hyper: Hyperparameters) -> Array:
    """Return a parent's contribution to precision times mean of its cycles: λ_z̄ z̄ in HLM."""
    shape = state.smoothness * _curvature(hyper.prior.reference(curves))
    return state.closeness * curves + shape


def _curvature(curves: Array) -> Array:
    """Return the Laplacian of the ring times curves (M, …)."""
    return 2.0 * curves - np.roll(curves, 1, axis=0) - np.roll(curves, -1, axis=0)
