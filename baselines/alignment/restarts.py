"""EM from random starts.

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mocapbench.baselines.alignment.cycle_model import Hyperparameters, State
from mocapbench.baselines.alignment.cycle_start import GROUPINGS, first_cycle, start_em
from mocapbench.baselines.alignment.ring import Ring
from mocapbench.baselines.alignment.updates import (
    Update,
    expectation_maximisation,
    update_closeness,
    update_cycles,
    update_jumps,
    update_labels,
    update_parent,
    update_paths,
    update_precisions,
    update_smoothness,
    update_weights,
)
from mocapbench.baselines.common.ascent import Ascent
from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.basics.arrays import Array

__all__ = ["copy_style", "random_cycle", "random_start", "run_em", "run_from_random_start"]

# Cycles first: while all styles have the same cycle, an update makes all labels equal.
_E_STEP: tuple[Update, ...] = (update_cycles, update_labels, update_paths)
_M_STEP: tuple[Update, ...] = (
    update_parent,
    update_smoothness,
    update_precisions,
    update_weights,
    update_jumps,
)
_COMMON_ITER = 5  # iterations with one style, which align the sequences well enough to group them
_CLOSENESS: dict[bool, tuple[Update, ...]] = {False: (), True: (update_closeness,)}


def run_from_random_start(
    sequences: Sequences,
    n_states: int,
    hyper: Hyperparameters,
    max_iter: int,
    rng: np.random.Generator,
) -> Ascent[State]:
    """Run EM from a random start."""
    return run_em(random_start(sequences, n_states, hyper, rng), sequences, hyper, max_iter)


def run_em(
    state: State, sequences: Sequences, hyper: Hyperparameters, max_iter: int
) -> Ascent[State]:
    """Run EM from a state."""
    return expectation_maximisation(
        state,
        sequences,
        hyper,
        e_step=_E_STEP,
        m_step=_CLOSENESS[hyper.learn_closeness] + _M_STEP,
        max_iter=max_iter,
    )


def random_start(
    sequences: Sequences, n_states: int, hyper: Hyperparameters, rng: np.random.Generator
) -> State:
    """Return a start: all sequences aligned to one cycle, then styles by the grouping.

    The first cycle is that of a random sequence, as in HLM §4. HLM starts with nearly uniform
    labels instead, so that styles differ by noise alone and each style aligns separately.
    """
    common = start_em(random_cycle(sequences, n_states, rng), sequences, hyper)
    aligned = run_em(common, sequences, hyper, _COMMON_ITER).state
    styles = GROUPINGS[hyper.grouping](aligned, sequences, hyper.n_styles, rng)
    return copy_style(aligned, np.eye(hyper.n_styles)[styles])


def copy_style(state: State, labels: Array) -> State:
    """Return the state of one style with as many copies of it as ``labels`` (K, C) has styles."""
    n_styles, cycles = labels.shape[1], state.cycles
    copies = Ring(
        mean=np.repeat(cycles.mean, n_styles, axis=1),
        variance=np.repeat(cycles.variance, n_styles, axis=1),
        neighbour=np.repeat(cycles.neighbour, n_styles, axis=1),
        log_determinant=np.repeat(cycles.log_determinant, n_styles, axis=0),
    )
    return replace(
        state,
        precisions=np.repeat(state.precisions, n_styles, axis=0),
        weights=np.full(n_styles, 1.0 / n_styles),
        cycles=copies,
        labels=labels,
    )


def random_cycle(sequences: Sequences, n_states: int, rng: np.random.Generator) -> Array:
    """Return the first cycle of a random sequence that is long enough, or of any if none is."""
    n_frames = n_states // 2
    whole = np.flatnonzero((sequences.lengths >= n_frames) & (sequences.counts.sum(axis=1) > 0))
    chosen = rng.choice(whole) if len(whole) else rng.integers(len(sequences.lengths))
    return first_cycle(sequences.arrays()[chosen], n_frames, n_states)
