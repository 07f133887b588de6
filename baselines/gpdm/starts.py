"""Where the latent positions of a sequence to fill start from.

The conditional objective has a basin for every way through a gap, and descent stays in the one
where it starts: the start decides more than the way of learning.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray
from sklearn.metrics.pairwise import euclidean_distances

from mocapbench.baselines.common.shortest_path import cheapest_path
from mocapbench.baselines.gpdm.conditional import Conditional, Query
from mocapbench.baselines.gpdm.rollout import followed

__all__ = ["STARTS", "linear", "mean_prediction", "viterbi", "window"]

Array = NDArray[np.float64]
Start = Callable[[Conditional, Query], Array]

_MIN_OVERLAP = 8
"""Visible frames that a training window has to be compared at, or all if there are fewer."""


def linear(model: Conditional, query: Query) -> Array:
    """Put visible frames where the nearest training frame is, and hidden ones on lines between.

    Before the first and after the last visible frame, the nearest one is held.
    """
    nearest = euclidean_distances(query.poses[query.visible], model.poses).argmin(axis=1)
    frames, known = np.arange(len(query.visible)), np.flatnonzero(query.visible)
    columns = model.x[nearest].T
    return np.stack([np.interp(frames, known, column) for column in columns], axis=1)


def mean_prediction(model: Conditional, query: Query) -> Array:
    """Go through each gap by the mean of the dynamics, one frame from the last (§5.1)."""
    x = linear(model, query)
    first = np.flatnonzero(query.visible)[0]
    hidden = np.flatnonzero(~query.visible)
    return followed(model.motion, x, hidden[hidden > first])


def window(model: Conditional, query: Query) -> Array:
    """Take the one stretch of training, at any shift, that is nearest to the visible frames.

    Past its ends the first position is held and the last is followed by the dynamics.
    """
    errors = euclidean_distances(query.poses, model.poses, squared=True)
    errors[~query.visible] = 0.0
    n_frames, starts = len(query.visible), np.cumsum((0, *model.lengths))[:-1]
    wanted = min(_MIN_OVERLAP, int(query.visible.sum()))
    best, frames, rows = np.inf, np.arange(0), np.arange(0)
    for start, length in zip(starts, model.lengths, strict=True):
        for shift in range(1 - n_frames, length):
            inside = np.arange(max(0, -shift), min(n_frames, length - shift))
            n_compared = query.visible[inside].sum()
            if n_compared < wanted:
                continue
            error = errors[inside, start + shift + inside].sum() / n_compared
            if error < best:
                best, frames, rows = error, inside, start + shift + inside
    if not len(frames):
        return linear(model, query)
    x = model.x[rows][np.clip(np.arange(n_frames) - frames[0], 0, len(rows) - 1)]
    return followed(model.motion, x, np.arange(frames[-1] + 1, n_frames))


def viterbi(model: Conditional, query: Query) -> Array:
    """Take the most probable path through the training positions.

    Visible frames are reconstructions of their positions with white noise, and each position
    follows from the last by the dynamics.
    """
    precision = np.exp(model.reconstruction.theta[-1])
    emission = np.zeros((len(query.visible), len(model.x)))
    emission[query.visible] = (
        0.5 * precision * euclidean_distances(query.poses[query.visible], model.poses, squared=True)
    )
    mean, variance = model.motion.step(model.predecessors())
    jumps = euclidean_distances(mean, model.x, squared=True) / variance[:, None]
    transition = 0.5 * (jumps + model.x.shape[1] * np.log(variance)[:, None])
    return np.asarray(model.x[cheapest_path(emission, transition)])


STARTS: Mapping[str, Start] = {
    "linear": linear,
    "mean-prediction": mean_prediction,
    "window": window,
    "viterbi": viterbi,
}
