"""Where EM starts: HLM §4, "Comparison"."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.alignment.chain import Paths
from mocapbench.baselines.alignment.model import Evidence, Hyperparameters, Parameters, State
from mocapbench.baselines.alignment.ring import Ring
from mocapbench.baselines.alignment.sequences import Array, Sequences
from mocapbench.baselines.alignment.updates import update_paths

__all__ = ["first_cycle", "start"]


def start(
    parent: Array,
    sequences: Sequences,
    labels: Array,
    *,
    closeness: float,
    smoothness: float,
    max_jump: int,
    hyper: Hyperparameters,
) -> State:
    """Return the state in which every style's cycle is the parent (M, F)."""
    n_sequences, n_styles = labels.shape
    n_states, n_channels = parent.shape
    variance = sequences.squares.sum(axis=0) / np.maximum(sequences.counts.sum(axis=0), 1.0)
    precision = 1.0 / np.maximum(variance, 1.0 / hyper.max_precision)
    parameters = Parameters(
        parent,
        smoothness,
        closeness,
        np.tile(precision, (n_styles, 1)),
        np.full(n_styles, 1.0 / n_styles),
        np.full((n_sequences, max_jump), 1.0 / max_jump),
    )
    shape = (n_states, n_styles, n_channels)
    cycles = Ring(
        np.broadcast_to(parent[:, None], shape),
        np.broadcast_to(1.0 / precision, shape),
        np.zeros(shape),
        np.tile(n_states * np.log(precision), (n_styles, 1)),
    )
    nothing = Paths(np.zeros((0, 0, n_states)), np.zeros((0, max_jump)), np.zeros(0))
    blank = State(parameters, cycles, labels, nothing, Evidence(np.zeros(0), np.zeros(0)))
    return update_paths(blank, sequences, hyper)


def first_cycle(frames: Array, n_frames: int, n_states: int) -> Array:
    """Stretch the first ``n_frames`` of a sequence (N, F), NaN where hidden, to (M, F).

    Linear in time between the visible entries of a channel; 0 for one that shows none.
    """
    given = frames[:n_frames]
    positions = np.linspace(0.0, len(given), n_states, endpoint=False)
    cycle = np.zeros((n_states, frames.shape[1]))
    for channel, column in zip(cycle.T, given.T, strict=True):
        known = np.flatnonzero(~np.isnan(column))
        if len(known):
            channel[:] = np.interp(positions, known, column[known])
    return cycle
