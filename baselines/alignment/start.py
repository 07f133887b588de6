"""The initial state of EM, and the groups of aligned sequences that styles start from.

HLM §4, "Comparison".

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.alignment.chain import Paths, viterbi
from mocapbench.baselines.alignment.expectations import emission
from mocapbench.baselines.alignment.model import CycleParameters, Evidence, Hyperparameters, State
from mocapbench.baselines.alignment.ring import Ring
from mocapbench.baselines.alignment.sequences import Sequences
from mocapbench.baselines.alignment.updates import update_paths
from mocapbench.baselines.common.prototypes import group_rows, of_unit_variance, tempi
from mocapbench.baselines.common.recordings import interpolated
from mocapbench.basics.arrays import Array

__all__ = [
    "GROUPINGS",
    "best_paths",
    "first_cycle",
    "prototype",
    "prototypes",
    "random_styles",
    "similar_styles",
    "start",
]

Grouping = Callable[[State, Sequences, int, np.random.Generator], NDArray[np.intp]]

_N_STARTS = 10  # of K-means, which costs little beside an iteration of EM


def start(
    parent: Array,
    sequences: Sequences,
    *,
    closeness: float,
    smoothness: float,
    max_jump: int,
    hyper: Hyperparameters,
) -> State:
    """Return the state with one style, whose cycle is ``parent`` (M, F).

    The noise variances are those of the visible entries, and the variances of the cycle are equal
    to them.
    """
    n_sequences, (n_states, n_channels) = len(sequences.lengths), parent.shape
    variance = sequences.squares.sum(axis=0) / np.maximum(sequences.counts.sum(axis=0), 1.0)
    precision = 1.0 / np.maximum(variance, 1.0 / hyper.max_precision)
    parameters = CycleParameters(
        parent,
        smoothness,
        closeness,
        precision[None],
        np.ones(1),
        np.full((n_sequences, max_jump), 1.0 / max_jump),
    )
    shape = (n_states, 1, n_channels)
    cycles = Ring(
        parent[:, None],
        np.broadcast_to(1.0 / precision, shape),
        np.zeros(shape),
        n_states * np.log(precision)[None],
    )
    no_paths = Paths(np.zeros((0, 0, n_states)), np.zeros((0, max_jump)), np.zeros(0))
    no_evidence = Evidence(np.zeros(0), np.zeros(0))
    labels = np.ones((n_sequences, 1))
    return update_paths(State(parameters, cycles, labels, no_paths, no_evidence), sequences, hyper)


def first_cycle(frames: Array, n_frames: int, n_states: int) -> Array:
    """Return the first ``n_frames`` of a sequence (N, F), NaN where hidden, resampled to (M, F).

    Channels are interpolated linearly between visible entries; one without any is 0.
    """
    given = frames[:n_frames]
    positions = np.linspace(0.0, len(given), n_states, endpoint=False)
    numbers = np.arange(len(given), dtype=np.float64)
    return np.nan_to_num(interpolated(given, numbers, positions))


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
    """Return a style (K,) for each sequence aligned to one cycle, by K-means on shape and tempo.

    Both count alike, as in multiple factor analysis (B. Escofier, J. Pagès 1994, Computational
    Statistics & Data Analysis 18:121–140): the first axis of the shapes has the largest variance
    that tempi have, if they are known well. Every sequence has a style of its own, in random order,
    if there are enough styles.
    """
    n_sequences = len(sequences.lengths)
    if n_sequences <= n_styles:
        return random_styles(state, sequences, n_styles, rng)
    paths, trace = best_paths(state, sequences), state.cycles.mean[:, 0]
    shapes = prototypes(paths, sequences, trace).reshape(n_sequences, -1)
    features = np.column_stack([of_unit_variance(shapes), tempi(paths, len(trace))])
    return group_rows(features, n_styles, _N_STARTS, rng)


GROUPINGS: dict[str, Grouping] = {"random": random_styles, "similar": similar_styles}
"""How the first styles are made, by name."""
