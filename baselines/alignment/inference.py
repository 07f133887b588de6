"""Inference given a fitted model: posteriors of new sequences, and hidden entries.

In the model, the noise of a frame is independent between channels. In recordings it is not: a leg
that swings further than its cycle goes with an arm that does. The covariance of the errors of
visible entries corrects the hidden ones, frame by frame, by Gaussian regression.

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from sklearn.covariance import ledoit_wolf

from mocapbench.baselines.alignment.cycle_model import Hyperparameters, State, sequence_bounds
from mocapbench.baselines.alignment.restarts import run_em
from mocapbench.baselines.alignment.updates import (
    expectation_maximisation,
    update_cycles,
    update_jumps,
    update_labels,
    update_paths,
    update_precisions,
)
from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.basics.arrays import Array
from mocapbench.basics.mask_runs import frames_alike

__all__ = ["correct_means", "error_correlation", "infer_path", "refine_state"]

_MAX_ITER = 30
_TOLERANCE = 1e-8
_OWN = 1e-3  # least variance of a channel's own error, so that channels without errors do no harm
_EMPTY = 0.5  # a style with fewer expected sequences counts as empty


def infer_path(sequence: Sequences, fitted: State, hyper: Hyperparameters) -> State:
    """Return Q(l), Q(π) and the jumps of one new sequence, given the fitted cycles.

    EM starts from the style with the highest bound when the sequence belongs to one style only.
    """
    styles = np.eye(len(fitted.weights))
    max_jump = fitted.jumps.shape[1]
    jumps = np.full((1, max_jump), 1.0 / max_jump)
    # The sequence in every style alone, as copies that share nothing but the cycles.
    copies = Sequences.of(sequence.arrays() * len(styles))
    in_each = replace(fitted, labels=styles, jumps=jumps.repeat(len(styles), axis=0))
    alone = update_paths(in_each, copies, hyper)
    best = sequence_bounds(alone, copies, hyper).argmax()
    return expectation_maximisation(
        update_paths(replace(fitted, labels=styles[[best]], jumps=jumps), sequence, hyper),
        sequence,
        replace(hyper, n_inner=1, tol=_TOLERANCE),
        e_step=(update_labels, update_paths),
        m_step=(update_jumps,),
        max_iter=_MAX_ITER,
    ).state


def refine_state(
    sequence: Sequences, fitted: State, sequences: Sequences, hyper: Hyperparameters, max_iter: int
) -> State:
    """Return the state after further EM with one new sequence, which comes last.

    EM continues from the fitted state, with the new sequence in its best existing style and, if a
    style is empty, also with the new sequence alone in that style. The run with the higher bound
    is returned.
    """
    joined = sequences.join(sequence)
    first = _join_states(fitted, infer_path(sequence, fitted, hyper))
    runs = [
        run_em(update_paths(state, joined, hyper), joined, hyper, max_iter)
        for state in (first, *_in_empty_style(first, joined, hyper))
    ]
    return max(runs, key=lambda result: result.objectives[-1]).state


def error_correlation(errors: Array) -> Array:
    """Return the correlations of errors (N, F) between channels, shrunk after Ledoit and Wolf.

    An entry that is hidden has error 0, which pulls correlations towards zero.
    """
    shrunk = ledoit_wolf(errors, assume_centered=True)[0]
    return np.asarray(shrunk + _OWN * np.eye(len(shrunk)))


def correct_means(mean: Array, sequences: Sequences) -> Array:
    """Return the means (N, F) of the last sequence, corrected by the visible errors of its frames.

    Variances are left as they are: errors of style and state are not Gaussian, and variances that
    shrink with the correction would be too small.

    Parameters
    ----------
    mean : ndarray of shape (K, N, F)
        The mean of every entry by style and state alone.
    sequences : Sequences
        The K sequences.
    """
    # Errors of all visible entries, in units of each channel's own, and their correlations.
    errors = (sequences.values - mean) * sequences.visible
    seen = errors[sequences.frames]
    unit = np.sqrt((seen**2).mean(axis=0)) + np.finfo(float).tiny
    correlation = error_correlation(seen / unit)
    n_frames = sequences.lengths[-1]
    filled = mean[-1, :n_frames].copy()
    last, visible = errors[-1, :n_frames] / unit, sequences.visible[-1, :n_frames] > 0
    for frames, known in frames_alike(visible):
        if known.all() or not known.any():
            continue
        # The regression Σ_uk Σ_kk⁻¹ of unknown on known errors, in units of the channels.
        gain = np.linalg.solve(
            correlation[np.ix_(known, known)], correlation[np.ix_(known, ~known)]
        )
        filled[np.ix_(frames, ~known)] += last[np.ix_(frames, known)] @ gain * unit[~known]
    return filled


def _join_states(fitted: State, new: State) -> State:
    """Return the state of the fitted and new sequences, but for the paths' posterior."""
    paths = replace(
        fitted.paths,
        counts=np.concatenate([fitted.paths.counts, new.paths.counts]),
        sums=np.concatenate([fitted.paths.sums, new.paths.sums]),
    )
    return replace(
        fitted,
        labels=np.concatenate([fitted.labels, new.labels]),
        jumps=np.concatenate([fitted.jumps, new.jumps]),
        paths=paths,
    )


def _in_empty_style(state: State, sequences: Sequences, hyper: Hyperparameters) -> list[State]:
    """Return the state with the last sequence alone in an empty style; nothing if none is empty."""
    sizes = state.labels[:-1].sum(axis=0)
    if sizes.min() > _EMPTY:
        return []
    labels = np.concatenate([state.labels[:-1], np.eye(len(sizes))[[sizes.argmin()]]])
    alone = replace(state, labels=labels)
    for update in (update_cycles, update_precisions, update_cycles):
        alone = update(alone, sequences, hyper)
    return [alone]
