"""Inference given a fitted model: posteriors of new sequences and moments of hidden entries.

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mocapbench.baselines.alignment.bound import sequence_bounds
from mocapbench.baselines.alignment.em import Update, expectation_maximisation
from mocapbench.baselines.alignment.fitting import EMSettings, run
from mocapbench.baselines.alignment.model import Hyperparameters, State
from mocapbench.baselines.alignment.sequences import Array, Sequences
from mocapbench.baselines.alignment.updates import (
    update_cycles,
    update_jumps,
    update_labels,
    update_paths,
    update_precisions,
)

__all__ = ["infer", "moments", "refine"]

_MAX_ITER = 30
_TOLERANCE = 1e-8
_EMPTY = 0.5  # a style with fewer expected sequences counts as empty


def infer(sequence: Sequences, fitted: State, hyper: Hyperparameters) -> State:
    """Return Q(l), Q(π) and the jumps of one new sequence, given the fitted cycles.

    EM starts from the style with the highest bound when the sequence belongs to one style only.
    """
    styles = np.eye(len(fitted.parameters.weights))
    max_jump = fitted.parameters.jumps.shape[1]
    jumps = np.full((1, max_jump), 1.0 / max_jump)
    copies = Sequences.of(sequence.arrays() * len(styles))
    alone = update_paths(_with(fitted, styles, jumps.repeat(len(styles), axis=0)), copies, hyper)
    best = sequence_bounds(alone, copies, hyper).argmax()
    return expectation_maximisation(
        update_paths(_with(fitted, styles[[best]], jumps), sequence, hyper),
        sequence,
        hyper,
        e_step=(update_labels, update_paths),
        m_step=(update_jumps,),
        n_inner=1,
        max_iter=_MAX_ITER,
        tolerance=_TOLERANCE,
    ).state


def refine(
    sequence: Sequences, fitted: State, sequences: Sequences, settings: EMSettings, max_iter: int
) -> State:
    """Return the state after further EM with one new sequence, which comes last.

    EM continues from the fitted state, with the new sequence in its best existing style and, if a
    style is empty, also with the new sequence alone in that style. The run with the higher bound
    is returned.
    """
    joined = sequences.join(sequence)
    first = _joined(fitted, infer(sequence, fitted, settings.hyper))
    runs = [
        run(update_paths(state, joined, settings.hyper), joined, settings, max_iter)
        for state in (first, *_in_empty_style(first, joined, settings.hyper))
    ]
    return max(runs, key=lambda attempt: attempt.bounds[-1]).state


def moments(state: State) -> tuple[Array, Array]:
    """Return the mean and variance of every entry, noise included: (K, N, F) each.

    These are the moments of the mixture over states and styles. HLM eq. (18) weights styles by
    their precision instead.
    """
    cycles, noise = state.cycles, 1.0 / state.parameters.precisions
    mean = _expected(state, cycles.mean)
    second = _expected(state, cycles.mean**2 + cycles.variance + noise)
    return mean, second - mean**2


def _expected(state: State, statistic: Array) -> Array:
    """Average (M, C, F) over the styles and states of each frame: (K, N, F)."""
    return np.asarray(state.paths.occupancy @ np.einsum("kc,mcf->kmf", state.labels, statistic))


def _with(state: State, labels: Array, jumps: Array) -> State:
    """Return the state with the labels and jumps of other sequences."""
    return replace(state, labels=labels, parameters=replace(state.parameters, jumps=jumps))


def _joined(fitted: State, new: State) -> State:
    """Return the state of the fitted and new sequences; the paths are left as they were."""
    joined = _with(
        fitted,
        np.concatenate([fitted.labels, new.labels]),
        np.concatenate([fitted.parameters.jumps, new.parameters.jumps]),
    )
    return replace(joined, evidence=fitted.evidence.join(new.evidence))


def _in_empty_style(state: State, sequences: Sequences, hyper: Hyperparameters) -> list[State]:
    """Return the state with the last sequence alone in an empty style; nothing if none is empty."""
    sizes = state.labels[:-1].sum(axis=0)
    if sizes.min() > _EMPTY:
        return []
    labels = np.concatenate([state.labels[:-1], np.eye(len(sizes))[[sizes.argmin()]]])
    steps: tuple[Update, ...] = (update_cycles, update_precisions, update_cycles)
    alone = replace(state, labels=labels)
    for update in steps:
        alone = update(alone, sequences, hyper)
    return [alone]
