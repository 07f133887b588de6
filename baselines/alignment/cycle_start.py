"""Where EM starts: the length of a cycle, the initial state, and the groups that styles start from.

HLM §4, "Comparison". The length of a cycle is estimated by autocorrelation.

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.alignment.chain import viterbi
from mocapbench.baselines.alignment.cycle_model import Hyperparameters, Paths, State, emission
from mocapbench.baselines.alignment.ring import Ring
from mocapbench.baselines.alignment.updates import update_paths
from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.baselines.common.prototypes import group_rows, of_unit_variance, tempi
from mocapbench.baselines.common.recordings import interpolate_channels
from mocapbench.basics.arrays import Array

__all__ = [
    "GROUPINGS",
    "autocorrelation",
    "best_paths",
    "cycle_length",
    "default_states",
    "first_cycle",
    "prototype",
    "prototypes",
    "random_styles",
    "similar_styles",
    "start_em",
]

Grouping = Callable[[State, Sequences, int, np.random.Generator], NDArray[np.intp]]

_N_STARTS = 10  # of K-means, which costs little beside an iteration of EM
_FEWEST_REPEATS = 2  # a sequence is at least this many times as long as a lag that is considered
# A lag of two cycles correlates as highly as one of a single cycle, up to noise: of all peaks this
# close to the highest, the first is the cycle.
_AS_GOOD = 0.9


def start_em(parent: Array, sequences: Sequences, hyper: Hyperparameters) -> State:
    """Return the state with one style, whose cycle is ``parent`` (M, F).

    The noise variances are those of the visible entries, and the variances of the cycle are equal
    to them.
    """
    n_sequences, (n_states, n_channels) = len(sequences.lengths), parent.shape
    variance = sequences.squares.sum(axis=0) / np.maximum(sequences.counts.sum(axis=0), 1.0)
    precision = 1.0 / np.maximum(variance, 1.0 / hyper.max_precision)
    shape = (n_states, 1, n_channels)
    cycles = Ring(
        parent[:, None],
        np.broadcast_to(1.0 / precision, shape),
        np.zeros(shape),
        n_states * np.log(precision)[None],
    )
    no_paths = Paths(*np.zeros((5, 0)))
    state = State(
        parent,
        hyper.smoothness,
        hyper.closeness,
        precision[None],
        weights=np.ones(1),
        jumps=np.full((n_sequences, hyper.max_jump), 1.0 / hyper.max_jump),
        cycles=cycles,
        labels=np.ones((n_sequences, 1)),
        paths=no_paths,
    )
    return update_paths(state, sequences, hyper)


def first_cycle(frames: Array, n_frames: int, n_states: int) -> Array:
    """Return the first ``n_frames`` of a sequence (N, F), NaN where hidden, resampled to (M, F).

    Channels are interpolated linearly between visible entries; one without any is 0.
    """
    given = frames[:n_frames]
    positions = np.linspace(0.0, len(given), n_states, endpoint=False)
    numbers = np.arange(len(given), dtype=np.float64)
    return np.nan_to_num(interpolate_channels(given, numbers, positions))


def best_paths(state: State, sequences: Sequences) -> tuple[NDArray[np.intp], ...]:
    """Return the most likely path (N_k,) of each sequence."""
    expected = emission(sequences, state.cycles, state.precisions, state.labels)
    return viterbi(expected, state.jumps, sequences.frames)


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
    # Positions count states on through the cycles, so that they rise with the frames.
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


def autocorrelation(sequences: Sequences) -> Array:
    """Return the autocorrelation of each sequence at lags 0 to N − 1: (K, N).

    It is pooled over channels and averaged over the pairs of entries that are both visible; NaN at
    a lag without such pairs.
    """
    visible = sequences.visible
    n_frames = visible.shape[1]
    seen = np.maximum(sequences.counts, 1.0)
    mean = sequences.values.sum(axis=1) / seen
    centred = (sequences.values - mean[:, None]) * visible
    # The autocorrelations of values and of masks: sums of products, and numbers of pairs.
    products, pairs = (_lagged_products(array)[:, :n_frames] for array in (centred, visible))
    pairs = np.round(pairs)
    covariance = np.divide(products, pairs, out=np.full_like(pairs, np.nan), where=pairs > 0)
    variance = np.where(covariance[:, :1] > 0, covariance[:, :1], np.nan)
    return np.asarray(covariance / variance)


def cycle_length(sequences: Sequences) -> int:
    """Return the expected number of frames of a cycle, N of HLM.

    It is the median over sequences of the first lag at which a sequence recurs: the first peak of
    the autocorrelation after its first negative value, within half the sequence, that is at least
    0.9 times as high as the highest such peak. If no sequence has one, each sequence counts as one
    cycle, and the median length is returned.
    """
    lags = [
        _first_return(correlation[: length // _FEWEST_REPEATS + 1])
        for correlation, length in zip(autocorrelation(sequences), sequences.lengths, strict=True)
    ]
    periods = [lag for lag in lags if lag]
    return int(np.median(periods if periods else sequences.lengths))


def default_states(sequences: Sequences, max_jump: int) -> int:
    """Return M = 2N as in HLM §2, but at least ``2 * max_jump + 1``."""
    return max(2 * cycle_length(sequences), 2 * max_jump + 1)


def _lagged_products(array: Array) -> Array:
    """Return Σ_f Σ_i a_i a_{i+lag} for each lag, by the Fourier transform."""
    size = 2 * array.shape[1]
    power = np.abs(np.fft.rfft(array, size, axis=1)) ** 2
    return np.fft.irfft(power.sum(axis=2), size, axis=1)


def _first_return(correlation: Array) -> int:
    """Return the lag of the first high peak after the first negative value; 0 if none."""
    negative = np.flatnonzero(correlation < 0)
    if not len(negative):
        return 0
    inner = correlation[1:-1]
    peak = (inner > correlation[:-2]) & (inner >= correlation[2:])
    peaks = np.flatnonzero(peak) + 1
    peaks = peaks[(peaks > negative[0]) & (correlation[peaks] > 0)]
    heights = correlation[peaks]
    return int(peaks[np.argmax(heights >= _AS_GOOD * heights.max())]) if len(peaks) else 0
