"""The continuous profile model (CPM) on a ring: one latent trace, a point estimate.

It is the model of HLM with a single style, whose cycle has no variance and no parent. The trace is
penalised by η times its squared steps, like HLM's parent.

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mocapbench.baselines.alignment import ring
from mocapbench.baselines.alignment.bound import sequence_bounds
from mocapbench.baselines.alignment.em import expectation_maximisation
from mocapbench.baselines.alignment.model import Hyperparameters, State
from mocapbench.baselines.alignment.ring import Ring
from mocapbench.baselines.alignment.sequences import Sequences
from mocapbench.baselines.alignment.start import start
from mocapbench.baselines.alignment.updates import update_jumps, update_paths, update_precisions
from mocapbench.baselines.common.ascent import Ascent
from mocapbench.basics.arrays import Array

__all__ = ["fit_profile", "penalised_likelihood", "update_trace"]


def fit_profile(
    trace: Array,
    sequences: Sequences,
    hyper: Hyperparameters,
    *,
    max_jump: int,
    max_iter: int,
    tol: float,
) -> Ascent[State]:
    """Run EM from a trace (M, F)."""
    state = start(trace, sequences, closeness=1.0, smoothness=1.0, max_jump=max_jump, hyper=hyper)
    pointed = replace(state, cycles=_point(trace[:, None]))
    return expectation_maximisation(
        update_paths(pointed, sequences, hyper),
        sequences,
        hyper,
        e_step=(update_trace, update_paths),
        m_step=(update_precisions, update_jumps, update_paths),
        n_inner=1,
        max_iter=max_iter,
        tol=tol,
        objective=penalised_likelihood,
    )


def update_trace(state: State, _: Sequences, hyper: Hyperparameters) -> State:
    """Maximise the expected log-likelihood less η times the trace's squared steps."""
    counts, sums = state.evidence.by_style(state.labels)
    precisions = state.parameters.precisions
    solved = ring.solve(2.0 * hyper.regularisation, precisions * counts, precisions * sums)
    return replace(state, cycles=_point(solved.mean))


def penalised_likelihood(state: State, sequences: Sequences, hyper: Hyperparameters) -> float:
    """Return log p(X | θ) plus the penalties on the trace and the jumps.

    Exact right after `update_paths`, else a lower bound.
    """
    steps = np.roll(state.cycles.mean, -1, axis=0) - state.cycles.mean
    penalty = hyper.regularisation * (steps**2).sum()
    return float(sequence_bounds(state, sequences, hyper).sum() - penalty)


def _point(mean: Array) -> Ring:
    """Return a cycle (M, 1, F) without uncertainty."""
    zero = np.zeros_like(mean)
    return Ring(mean, zero, zero, zero[0])
