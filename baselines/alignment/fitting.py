"""EM from random starts.

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mocapbench.baselines.alignment.em import Update, expectation_maximisation
from mocapbench.baselines.alignment.model import Hyperparameters, State
from mocapbench.baselines.alignment.ring import Ring
from mocapbench.baselines.alignment.sequences import Sequences
from mocapbench.baselines.alignment.start import GROUPINGS, first_cycle, start
from mocapbench.baselines.alignment.updates import (
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
from mocapbench.basics.arrays import Array

__all__ = ["EMSettings", "random_cycle", "random_start", "restarts", "run", "split"]

# Cycles first: while all styles have the same cycle, an update makes all labels equal.
_E_STEP: tuple[Update, ...] = (update_cycles, update_labels, update_paths)
_M_STEP: tuple[Update, ...] = (
    update_parent,
    update_smoothness,
    update_precisions,
    update_weights,
    update_jumps,
)
_COMMON_ITER = 5
_CLOSENESS: dict[bool, tuple[Update, ...]] = {False: (), True: (update_closeness,)}


@dataclass(frozen=True)
class EMSettings:
    """Settings of EM and of its start; names as in `CyclicAlignment`."""

    n_styles: int
    n_states: int
    max_jump: int
    closeness: float
    learn_closeness: bool
    smoothness: float
    hyper: Hyperparameters
    n_inner: int
    tol: float
    grouping: str = "random"


def restarts(
    sequences: Sequences,
    settings: EMSettings,
    *,
    n_restarts: int,
    max_iter: int,
    rng: np.random.Generator,
) -> list[Ascent[State]]:
    """Return runs of EM from random starts."""
    return [
        run(random_start(sequences, settings, rng), sequences, settings, max_iter)
        for _ in range(n_restarts)
    ]


def run(state: State, sequences: Sequences, settings: EMSettings, max_iter: int) -> Ascent[State]:
    """Run EM from a state."""
    return expectation_maximisation(
        state,
        sequences,
        settings.hyper,
        e_step=_E_STEP,
        m_step=_CLOSENESS[settings.learn_closeness] + _M_STEP,
        n_inner=settings.n_inner,
        max_iter=max_iter,
        tol=settings.tol,
    )


def random_start(sequences: Sequences, settings: EMSettings, rng: np.random.Generator) -> State:
    """Return a start: all sequences aligned to one cycle, then styles by the grouping.

    The first cycle is that of a random sequence, as in HLM §4. HLM starts with nearly uniform
    labels instead, so that styles differ by noise alone and each style aligns separately.
    """
    common = start(
        random_cycle(sequences, settings.n_states, rng),
        sequences,
        closeness=settings.closeness,
        smoothness=settings.smoothness,
        max_jump=settings.max_jump,
        hyper=settings.hyper,
    )
    aligned = run(common, sequences, settings, _COMMON_ITER).state
    group = GROUPINGS[settings.grouping]
    styles = group(aligned, sequences, settings.n_styles, rng)
    return split(aligned, np.eye(settings.n_styles)[styles])


def split(state: State, labels: Array) -> State:
    """Return the state of one style with as many copies of it as ``labels`` (K, C) has styles."""
    n_styles, cycles, theta = labels.shape[1], state.cycles, state.parameters
    copies = Ring(
        mean=np.repeat(cycles.mean, n_styles, axis=1),
        variance=np.repeat(cycles.variance, n_styles, axis=1),
        neighbour=np.repeat(cycles.neighbour, n_styles, axis=1),
        log_determinant=np.repeat(cycles.log_determinant, n_styles, axis=0),
    )
    parameters = replace(
        theta,
        precisions=np.repeat(theta.precisions, n_styles, axis=0),
        weights=np.full(n_styles, 1.0 / n_styles),
    )
    return replace(state, cycles=copies, parameters=parameters, labels=labels)


def random_cycle(sequences: Sequences, n_states: int, rng: np.random.Generator) -> Array:
    """Return the first cycle of a random sequence that is long enough, or of any if none is."""
    n_frames = n_states // 2
    whole = np.flatnonzero((sequences.lengths >= n_frames) & (sequences.counts.sum(axis=1) > 0))
    chosen = rng.choice(whole) if len(whole) else rng.integers(len(sequences.lengths))
    return first_cycle(sequences.arrays()[chosen], n_frames, n_states)
