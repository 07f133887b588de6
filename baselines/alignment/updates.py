"""The updates of HLM §3, one function each: none of them lowers the bound.

Numbers of equations are HLM's; where the paper errs, the docstring says what is right instead.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from scipy.linalg import solve_circulant

from mocapbench.baselines.alignment import ring
from mocapbench.baselines.alignment.chain import forward_backward
from mocapbench.baselines.alignment.expectations import (
    distance,
    emission,
    log_likelihood,
    residuals,
    roughness,
)
from mocapbench.baselines.alignment.model import Evidence, Hyperparameters, Parameters, State
from mocapbench.baselines.alignment.sequences import Array, Sequences

__all__ = [
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


def update_paths(state: State, sequences: Sequences, _: Hyperparameters) -> State:
    """Q(π), eq. (7), by forward–backward over the styles' expected log-likelihoods, eq. (10)."""
    parameters = state.parameters
    expected = emission(sequences, state.cycles, parameters.precisions, state.labels)
    paths = forward_backward(expected, parameters.jumps, sequences.frames)
    return replace(state, paths=paths, evidence=Evidence.of(sequences, paths))


def update_labels(state: State, sequences: Sequences, _: Hyperparameters) -> State:
    """Q(l), eq. (11), over visible entries."""
    score = np.log(state.parameters.weights) + log_likelihood(state, sequences)
    score -= score.max(axis=1, keepdims=True)
    labels = np.exp(score)
    return replace(state, labels=labels / labels.sum(axis=1, keepdims=True))


def update_cycles(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Q(Z), eq. (9).

    The precision of a channel has the diagonal 2λ_s + λ_z̄ + λ_f n_m, n_m the expected number of
    visible entries, and the mean solves for λ_z̄ z̄ + λ_f Σ γ x: the paper divides by n_m instead.
    """
    theta = state.parameters
    counts, sums = state.evidence.by_style(state.labels)
    ground = theta.closeness + theta.precisions * counts
    right = _pull(theta.parent, theta, hyper)[:, None] + theta.precisions * sums
    return replace(state, cycles=ring.solve(theta.smoothness, ground, right))


def update_parent(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Eq. (17) with its bracket: (Cλ_z̄ + 4η) z̄_m − 2η (z̄_{m−1} + z̄_{m+1}) = λ_z̄ Σ_c ⟨z_m^c⟩.

    Where the prior is centred, the whole precision of a cycle stands in place of λ_z̄.
    """
    theta, (n_states, n_styles, _channels) = state.parameters, state.cycles.mean.shape
    impulse = np.eye(n_states)[0]
    column = n_styles * _pull(impulse, theta, hyper)
    column += 2.0 * hyper.regularisation * _curvature(impulse)
    right = _pull(state.cycles.mean.sum(axis=1), theta, hyper)
    return _learnt(state, parent=solve_circulant(column, right))


def update_smoothness(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """λ_s, eq. (13), as the prior is normalised."""
    n_states, *batch = state.cycles.mean.shape
    reference = hyper.prior.reference(state.parameters.parent)
    mean = roughness(state.cycles, reference) / np.prod(batch)
    best = hyper.prior.smoothness(state.parameters.closeness, n_states, mean)
    return _learnt(state, smoothness=best)


def update_closeness(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """λ_z̄, eq. (12), as the prior is normalised."""
    n_states, *batch = state.cycles.mean.shape
    mean = distance(state.cycles, state.parameters.parent) / np.prod(batch)
    best = hyper.prior.closeness(state.parameters.smoothness, n_states, mean)
    return _learnt(state, closeness=best)


def update_precisions(state: State, sequences: Sequences, hyper: Hyperparameters) -> State:
    """λ_f^c, eq. (14), over visible entries; a style that nothing shows keeps its own."""
    counts = state.labels.T @ sequences.counts
    squares = np.einsum("kc,kcf->cf", state.labels, residuals(state, sequences))
    best = counts / np.maximum(squares, counts / hyper.max_precision + np.finfo(float).tiny)
    return _learnt(state, precisions=np.where(best > 0, best, state.parameters.precisions))


def update_weights(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """τ, eq. (15)."""
    weights = hyper.regularisation + state.labels.sum(axis=0)
    return _learnt(state, weights=weights / weights.sum())


def update_jumps(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """d, eq. (16), ξ being the joint posterior of two successive states."""
    jumps = hyper.regularisation + state.paths.jumps
    return _learnt(state, jumps=jumps / jumps.sum(axis=1, keepdims=True))


def _pull(curves: Array, theta: Parameters, hyper: Hyperparameters) -> Array:
    """Return what a parent (M, …) adds to precision times mean of its cycles; λ_z̄ z̄ in HLM."""
    shape = theta.smoothness * _curvature(hyper.prior.reference(curves))
    return theta.closeness * curves + shape


def _curvature(curves: Array) -> Array:
    """Return the Laplacian of the ring times curves (M, …)."""
    return 2.0 * curves - np.roll(curves, 1, axis=0) - np.roll(curves, -1, axis=0)


def _learnt(state: State, **parameters: Any) -> State:
    """Return the state with some parameters replaced."""
    return replace(state, parameters=replace(state.parameters, **parameters))
