"""The initial state of EM: HLM §4, "Comparison".

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.alignment.chain import Paths
from mocapbench.baselines.alignment.model import CycleParameters, Evidence, Hyperparameters, State
from mocapbench.baselines.alignment.ring import Ring
from mocapbench.baselines.alignment.sequences import Array, Sequences
from mocapbench.baselines.alignment.updates import update_paths

__all__ = ["first_cycle", "start"]


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
    cycle = np.zeros((n_states, frames.shape[1]))
    for channel, column in zip(cycle.T, given.T, strict=True):
        known = np.flatnonzero(~np.isnan(column))
        if len(known):
            channel[:] = np.interp(positions, known, column[known])
    return cycle
