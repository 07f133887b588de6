"""New cycles and sequences from a fitted model (HLM §2, generative process; §4.2, blending).

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.alignment.cycle_model import State
from mocapbench.baselines.alignment.ring import eliminate, sweep_back
from mocapbench.basics.arrays import Array

__all__ = ["blend_cycles", "draw_cycles", "draw_path", "draw_sequences"]


def draw_sequences(state: State, n: int, n_frames: int, rng: np.random.Generator) -> Array:
    """Return new sequences (n, N, F), noise included.

    Each takes its style and the probabilities of its jumps from a fitted sequence, drawn uniformly.
    """
    sequences = rng.integers(len(state.labels), size=n)
    styles = np.array([rng.choice(len(labels), p=labels) for labels in state.labels[sequences]])
    poses = np.empty((n, n_frames, state.cycles.mean.shape[2]))
    for style in np.unique(styles):
        (drawn,) = np.nonzero(styles == style)
        cycles = draw_cycles(state, style, len(drawn), rng)
        for index, cycle in zip(drawn, cycles, strict=True):
            jumps = state.jumps[sequences[index]]
            poses[index] = cycle[draw_path(jumps, len(cycle), n_frames, rng)]
    noise = rng.standard_normal(poses.shape)
    return np.asarray(poses + noise / np.sqrt(state.precisions[styles])[:, None])


def draw_cycles(state: State, style: int, n: int, rng: np.random.Generator) -> Array:
    """Return draws (n, M, F) from Q(Z) of a style, by one factorisation."""
    counts, _ = state.paths.by_style(state.labels[:, [style]])
    ground = state.closeness + state.precisions[style] * counts[:, 0]
    # The precision is R⁻ᵀ diag(pivots) R⁻¹, with R the backward sweep: R white has its inverse.
    pivots, near, far = eliminate(state.smoothness, ground)
    n_states, n_channels = ground.shape
    white = rng.standard_normal((n_states, n, n_channels)) / np.sqrt(pivots)[:, None]
    draws = state.cycles.mean[:, style, None] + sweep_back(near, far, white)
    return np.asarray(draws.transpose(1, 0, 2))


def draw_path(
    jumps: Array, n_states: int, n_frames: int, rng: np.random.Generator
) -> NDArray[np.intp]:
    """Return a random path (N,) of the chain; its first state is uniform."""
    steps = 1 + rng.choice(len(jumps), size=n_frames - 1, p=jumps)
    return np.cumsum(np.concatenate([rng.integers(n_states, size=1), steps])) % n_states


def blend_cycles(state: State, weights: Array) -> Array:
    """Return the styles' mean cycles mixed by weights (N, C), at the mean pace: (N, F).

    The pace is not a whole number of states; poses between states are interpolated linearly.

    Raises
    ------
    ValueError
        If the weights are not (N, C), are negative, or a row's sum is not 1.
    """
    _check_weights(weights, state.labels.shape[1])
    # The mean number of states a frame.
    jumps = state.jumps.mean(axis=0)
    pace = jumps @ np.arange(1, len(jumps) + 1)
    position = pace * np.arange(len(weights))
    return np.asarray(np.einsum("nc,ncf->nf", weights, _poses(state.cycles.mean, position)))


def _poses(cycles: Array, position: Array) -> Array:
    """Return cycles (M, …) at positions (N,) on the ring, interpolated linearly: (N, …)."""
    state, n_states = position.astype(np.intp), len(cycles)
    fraction = (position - state).reshape(-1, *[1] * (cycles.ndim - 1))
    return (1.0 - fraction) * cycles[state % n_states] + fraction * cycles[(state + 1) % n_states]


def _check_weights(weights: Array, n_styles: int) -> None:
    if weights.ndim != 2 or weights.shape[1] != n_styles:
        raise ValueError(
            f"expected weights of shape (N, {n_styles}), one column a style, got {weights.shape}"
        )
    if not (weights >= 0).all() or not np.allclose(weights.sum(axis=1), 1.0):
        raise ValueError("expected non-negative weights whose rows sum to 1: divide by the sum")
