"""New cycles and new sequences from a fitted model (HLM §2, the generative process; §4.2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.alignment import ring
from mocapbench.baselines.alignment.model import State
from mocapbench.baselines.alignment.sequences import Array

__all__ = ["blended", "draw_cycle", "draw_path", "draw_sequence"]


def draw_sequence(state: State, n_frames: int, rng: np.random.Generator) -> Array:
    """Return a new sequence (N, F), noise included, in the manner of one of the fitted ones.

    The manner is a fitted sequence's style and jumps, the sequence drawn evenly.
    """
    sequence = rng.integers(len(state.labels))
    style = rng.choice(state.labels.shape[1], p=state.labels[sequence])
    path = draw_path(state.parameters.jumps[sequence], len(state.cycles.mean), n_frames, rng)
    pose = draw_cycle(state, style, rng)[path]
    noise = rng.standard_normal(pose.shape) / np.sqrt(state.parameters.precisions[style])
    return np.asarray(pose + noise)


def draw_cycle(state: State, style: int, rng: np.random.Generator) -> Array:
    """Return a draw (M, F) of Q(Z) of a style."""
    theta = state.parameters
    counts, _ = state.evidence.by_style(state.labels[:, [style]])
    ground = theta.closeness + theta.precisions[style] * counts[:, 0]
    factor = ring.eliminate(theta.smoothness, ground)
    white = rng.standard_normal(ground.shape) / np.sqrt(factor.pivots)
    return np.asarray(state.cycles.mean[:, style] + factor.backward(white))


def draw_path(
    jumps: Array, n_states: int, n_frames: int, rng: np.random.Generator
) -> NDArray[np.intp]:
    """Return a path (N,) of the chain, its first state uniform."""
    steps = 1 + rng.choice(len(jumps), size=n_frames - 1, p=jumps)
    return np.cumsum(np.concatenate([rng.integers(n_states, size=1), steps])) % n_states


def blended(state: State, weights: Array) -> Array:
    """Return the styles' mean cycles mixed by weights (N, C), at the mean pace: (N, F).

    A pose between two states is between theirs, for a pace is not a whole number of states.

    Raises
    ------
    ValueError
        If the weights are not (N, C), are negative, or a row's sum is not 1.
    """
    _check_weights(weights, state.labels.shape[1])
    jumps = state.parameters.jumps.mean(axis=0)
    pace = jumps @ np.arange(1, len(jumps) + 1)
    position = pace * np.arange(len(weights))
    return np.asarray(np.einsum("nc,ncf->nf", weights, _poses(state.cycles.mean, position)))


def _poses(cycles: Array, position: Array) -> Array:
    """Return cycles (M, …) at positions (N,) on the ring, linear between states: (N, …)."""
    state, n_states = position.astype(np.intp), len(cycles)
    share = (position - state).reshape(-1, *[1] * (cycles.ndim - 1))
    return (1.0 - share) * cycles[state % n_states] + share * cycles[(state + 1) % n_states]


def _check_weights(weights: Array, n_styles: int) -> None:
    if weights.ndim != 2 or weights.shape[1] != n_styles:
        raise ValueError(
            f"expected weights of shape (N, {n_styles}), one column a style, got {weights.shape}"
        )
    if not (weights >= 0).all() or not np.allclose(weights.sum(axis=1), 1.0):
        raise ValueError("expected non-negative weights whose rows sum to 1: divide by the sum")
