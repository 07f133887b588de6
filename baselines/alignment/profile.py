"""The continuous profile model (CPM) on a ring: one latent trace, a point estimate.

It is the model of HLM with a single style, whose cycle has no variance and no parent. The trace is
penalised by η times its squared steps, like HLM's parent.

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mocapbench.baselines.alignment.cycle_model import Hyperparameters, State, sequence_bounds
from mocapbench.baselines.alignment.cycle_start import start_em
from mocapbench.baselines.alignment.ring import Ring, solve_rings
from mocapbench.baselines.alignment.updates import (
    expectation_maximisation,
    update_jumps,
    update_paths,
    update_precisions,
)
from mocapbench.baselines.common.ascent import Ascent
from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.basics.arrays import Array

__all__ = ["fit_profile", "penalised_likelihood", "update_trace"]


def fit_profile(
    trace: Array, sequences: Sequences, hyper: Hyperparameters, max_iter: int
) -> Ascent[State]:
    """Run EM from a trace (M, F)."""
    state = start_em(trace, sequences, hyper)
    certain = replace(state, cycles=_without_variance(trace[:, None]))
    return expectation_maximisation(
        update_paths(certain, sequences, hyper),
        sequences,
        hyper,
        e_step=(update_trace, update_paths),
        m_step=(update_precisions, update_jumps, update_paths),
        max_iter=max_iter,
        objective=penalised_likelihood,
    )


def update_trace(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Maximise the expected log-likelihood less η times the trace's squared steps."""
    counts, sums = state.paths.by_style(state.labels)
    precisions = state.precisions
    solved = solve_rings(2.0 * hyper.regularisation, precisions * counts, precisions * sums)
    return replace(state, cycles=_without_variance(solved.mean))


def penalised_likelihood(state: State, sequences: Sequences, hyper: Hyperparameters) -> float:
    """Return log p(X | θ) plus the penalties on the trace and the jumps.

    Exact right after `update_paths`, else a lower bound.
    """
    steps = np.roll(state.cycles.mean, -1, axis=0) - state.cycles.mean
    penalty = hyper.regularisation * (steps**2).sum()
    return float(sequence_bounds(state, sequences, hyper).sum() - penalty)


def _without_variance(mean: Array) -> Ring:
    """Return a cycle (M, 1, F) without uncertainty."""
    zero = np.zeros_like(mean)
    return Ring(mean, zero, zero, zero[0])
