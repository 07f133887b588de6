"""Initial latent trajectories of a sequence to fill.

The conditional objective has many local minima, and the optimiser stays near the one where it
starts: the start matters more than the learning algorithm.

Wang, Fleet and Hertzmann (2008), *Gaussian Process Dynamical Models for Human Motion*, IEEE TPAMI
30(2), is cited as GPDM.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from sklearn.metrics.pairwise import euclidean_distances

from mocapbench.baselines.common.shortest_path import cheapest_path
from mocapbench.baselines.gpdm.conditional import Conditional, Query
from mocapbench.baselines.gpdm.rollout import roll_out
from mocapbench.basics.arrays import Array, Index

__all__ = ["STARTS", "linear", "mean_prediction", "viterbi", "window"]

Start = Callable[[Conditional, Query], Array]

_MIN_OVERLAP = 8
"""Fewest visible frames at which a training window is compared; all, if fewer are visible."""


def linear(model: Conditional, query: Query) -> Array:
    """Place visible frames at the nearest training frame's position, and interpolate linearly.

    Before the first and after the last visible frame the position is held constant.
    """
    poses, visible = query
    nearest = euclidean_distances(poses[visible], model.poses).argmin(axis=1)
    frames, known = np.arange(len(visible)), np.flatnonzero(visible)
    columns = model.x[nearest].T
    return np.stack([np.interp(frames, known, column) for column in columns], axis=1)


def mean_prediction(model: Conditional, query: Query) -> Array:
    """Fill each gap by the dynamics' conditional mean, frame after frame (GPDM §5.1)."""
    (_, visible), x = query, linear(model, query)
    first, hidden = np.flatnonzero(visible)[0], np.flatnonzero(~visible)
    return roll_out(model.dynamics, x, hidden[hidden > first])


def window(model: Conditional, query: Query) -> Array:
    """Copy the training window, at any shift, that is nearest to the visible frames.

    Before the window its first position is held constant; after it the dynamics continue.
    """
    poses, visible = query
    errors = euclidean_distances(poses, model.poses, squared=True)
    errors[~visible] = 0.0
    frames, rows = _best_window(errors, visible, model.lengths)
    if not len(frames):
        return linear(model, query)
    n_frames = len(visible)
    x = model.x[rows][np.clip(np.arange(n_frames) - frames[0], 0, len(rows) - 1)]
    return roll_out(model.dynamics, x, np.arange(frames[-1] + 1, n_frames))


def viterbi(model: Conditional, query: Query) -> Array:
    """Return the most probable path through the training positions (Viterbi).

    Emissions are the visible frames under the noise of the mapping to poses; transitions are the
    conditional densities of the dynamics.
    """
    (poses, visible), precision = query, np.exp(model.reconstruction.theta[-1])
    emission = np.zeros((len(visible), len(model.x)))
    distances = euclidean_distances(poses[visible], model.poses, squared=True)
    emission[visible] = 0.5 * precision * distances
    # −ln N(x; mean, variance I), constants left out.
    mean, variance = model.dynamics.step(model.predecessors())
    jumps = euclidean_distances(mean, model.x, squared=True) / variance[:, None]
    transition = 0.5 * (jumps + model.x.shape[1] * np.log(variance)[:, None])
    return np.asarray(model.x[cheapest_path(emission, transition)])


def _best_window(
    errors: Array, visible: NDArray[np.bool_], lengths: Sequence[int]
) -> tuple[Index, Index]:
    """Return the frames that the nearest training window covers, and its rows; empty if none does.

    Parameters
    ----------
    errors : ndarray of shape (M, N)
        Of each frame, against each training frame; 0 where hidden.
    visible : ndarray of bool, shape (M,)
    lengths : sequence of int
        Frames of each training sequence.
    """
    n_frames, starts = len(visible), np.cumsum((0, *lengths))[:-1]
    least = min(_MIN_OVERLAP, int(visible.sum()))
    best, frames, rows = np.inf, np.arange(0), np.arange(0)
    for start, length in zip(starts, lengths, strict=True):
        for shift in range(1 - n_frames, length):
            inside = np.arange(max(0, -shift), min(n_frames, length - shift))
            n_compared = visible[inside].sum()
            if n_compared < least:
                continue
            error = errors[inside, start + shift + inside].sum() / n_compared
            if error < best:
                best, frames, rows = error, inside, start + shift + inside
    return frames, rows


STARTS: Mapping[str, Start] = {
    "linear": linear,
    "mean-prediction": mean_prediction,
    "window": window,
    "viterbi": viterbi,
}
