"""Sequences warped onto a common cycle, and the groups of them that styles start from."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.alignment.chain import viterbi
from mocapbench.baselines.alignment.expectations import emission
from mocapbench.baselines.alignment.model import State
from mocapbench.baselines.alignment.sequences import Array, Sequences
from mocapbench.baselines.common.prototypes import cluster_cycles

__all__ = [
    "GROUPINGS",
    "best_paths",
    "prototype",
    "prototypes",
    "random_styles",
    "similar_styles",
]

Grouping = Callable[[State, Sequences, int, np.random.Generator], NDArray[np.intp]]

_N_STARTS = 10  # of K-means, which costs little beside an iteration of EM


def best_paths(state: State, sequences: Sequences) -> tuple[NDArray[np.intp], ...]:
    """Return the most likely path (N_k,) of each sequence."""
    theta = state.parameters
    expected = emission(sequences, state.cycles, theta.precisions, state.labels)
    return viterbi(expected, theta.jumps, sequences.frames)


def prototypes(paths: tuple[NDArray[np.intp], ...], sequences: Sequences, trace: Array) -> Array:
    """Return the `prototype` of each sequence: (K, M, F)."""
    pairs = zip(sequences.arrays(), paths, strict=True)
    return np.stack([prototype(frames, path, trace) for frames, path in pairs])


def prototype(frames: Array, path: NDArray[np.intp], trace: Array) -> Array:
    """Return a sequence warped onto the cycle by its path and averaged over its cycles: (M, F).

    Between the states of its visible frames (N, F) it is interpolated linearly. At states that the
    sequence does not reach it equals the trace (M, F).
    """
    n_states = len(trace)
    position = path[0] + np.concatenate([[0], np.cumsum(np.diff(path) % n_states)])
    cycle = trace.copy()
    for channel, values in zip(cycle.T, frames.T, strict=True):
        known = np.flatnonzero(~np.isnan(values))
        if len(known):
            reached = np.arange(position[known[0]], position[known[-1]] + 1)
            warped = np.interp(reached, position[known], values[known])
            visits = np.bincount(reached % n_states, minlength=n_states)
            totals = np.bincount(reached % n_states, warped, minlength=n_states)
            np.divide(totals, visits, out=channel, where=visits > 0)
    return cycle


def random_styles(
    _: State, sequences: Sequences, n_styles: int, rng: np.random.Generator
) -> NDArray[np.intp]:
    """Return a style (K,) for each sequence: random groups of equal size."""
    return rng.permutation(len(sequences.lengths)) % n_styles


def similar_styles(
    state: State, sequences: Sequences, n_styles: int, rng: np.random.Generator
) -> NDArray[np.intp]:
    """Return a style (K,) for each sequence aligned to one cycle, by K-means on the prototypes.

    Every sequence has a style of its own, in random order, if there are enough styles.
    """
    if len(sequences.lengths) <= n_styles:
        return random_styles(state, sequences, n_styles, rng)
    trace = state.cycles.mean[:, 0]
    cycles = prototypes(best_paths(state, sequences), sequences, trace)
    unit = np.ones(trace.shape[1])  # sequences are standardised
    return cluster_cycles(cycles, unit, n_styles, _N_STARTS, rng)[0]


GROUPINGS: dict[str, Grouping] = {"random": random_styles, "similar": similar_styles}
"""How the first styles are made, by name."""
