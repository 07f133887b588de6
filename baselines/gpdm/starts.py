"""Initial latent trajectories of a sequence to fill.

The conditional objective has many local minima, and the optimiser stays near the one where it
starts: the start matters more than the learning algorithm.

Wang, Fleet and Hertzmann (2008), *Gaussian Process Dynamical Models for Human Motion*, IEEE TPAMI
30(2), is cited as GPDM.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from sklearn.metrics.pairwise import euclidean_distances

from mocapbench.baselines.common.shortest_path import cheapest_path
from mocapbench.baselines.gpdm.conditional import Conditional, Query
from mocapbench.baselines.gpdm.rollout import roll_out
from mocapbench.basics.arrays import Array

__all__ = ["STARTS", "linear", "mean_prediction", "viterbi", "window"]

Start = Callable[[Conditional, Query], Array]

_MIN_OVERLAP = 8
"""Fewest visible frames at which a training window is compared; all, if fewer are visible."""


def linear(model: Conditional, query: Query) -> Array:
    """Place visible frames at the nearest training frame's position, and interpolate linearly.

    Before the first and after the last visible frame the position is held constant.
    """
    nearest = euclidean_distances(query.poses[query.visible], model.poses).argmin(axis=1)
    frames, known = np.arange(len(query.visible)), np.flatnonzero(query.visible)
    columns = model.x[nearest].T
    return np.stack([np.interp(frames, known, column) for column in columns], axis=1)


def mean_prediction(model: Conditional, query: Query) -> Array:
    """Fill each gap by the dynamics' conditional mean, frame after frame (GPDM §5.1)."""
    x = linear(model, query)
    first = np.flatnonzero(query.visible)[0]
    hidden = np.flatnonzero(~query.visible)
    return roll_out(model.dynamics, x, hidden[hidden > first])


def window(model: Conditional, query: Query) -> Array:
    """Copy the training window, at any shift, that is nearest to the visible frames.

    Before the window its first position is held constant; after it the dynamics continue.
    """
    errors = euclidean_distances(query.poses, model.poses, squared=True)
    errors[~query.visible] = 0.0
    n_frames, starts = len(query.visible), np.cumsum((0, *model.lengths))[:-1]
    least = min(_MIN_OVERLAP, int(query.visible.sum()))
    best, frames, rows = np.inf, np.arange(0), np.arange(0)
    for start, length in zip(starts, model.lengths, strict=True):
        for shift in range(1 - n_frames, length):
            inside = np.arange(max(0, -shift), min(n_frames, length - shift))
            n_compared = query.visible[inside].sum()
            if n_compared < least:
                continue
            error = errors[inside, start + shift + inside].sum() / n_compared
            if error < best:
                best, frames, rows = error, inside, start + shift + inside
    if not len(frames):
        return linear(model, query)
    x = model.x[rows][np.clip(np.arange(n_frames) - frames[0], 0, len(rows) - 1)]
    return roll_out(model.dynamics, x, np.arange(frames[-1] + 1, n_frames))


def viterbi(model: Conditional, query: Query) -> Array:
    """Return the most probable path through the training positions (Viterbi).

    Emissions are the visible frames under the noise of the mapping to poses; transitions are the
    conditional densities of the dynamics.
    """
    precision = np.exp(model.reconstruction.theta[-1])
    emission = np.zeros((len(query.visible), len(model.x)))
    emission[query.visible] = (
        0.5 * precision * euclidean_distances(query.poses[query.visible], model.poses, squared=True)
    )
    mean, variance = model.dynamics.step(model.predecessors())
    jumps = euclidean_distances(mean, model.x, squared=True) / variance[:, None]
    transition = 0.5 * (jumps + model.x.shape[1] * np.log(variance)[:, None])
    return np.asarray(model.x[cheapest_path(emission, transition)])


STARTS: Mapping[str, Start] = {
    "linear": linear,
    "mean-prediction": mean_prediction,
    "window": window,
    "viterbi": viterbi,
}
