"""What a fitted model tells of itself besides its answer: kept with it, for figures."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines import Coregionalised, Dynamical, Embedded, Model, Trended
from mocapbench.benchmark.problems.base import Solution
from mocapbench.datasets import Recording

__all__ = ["disclosed"]

N_DIMENSIONS = 3
N_STEPS = 14
"""Points of the cloud along each side of the box around the training positions."""
MARGIN = 0.25
"""By how much the box is larger than what it holds, on either side."""
N_WALK, N_SAMPLES = 62, 3
"""Frames of a walk (GPDM §5.1: just less than a gait cycle at 60 Hz), and how many are drawn."""


def disclosed(model: Model, train: Sequence[Recording]) -> Solution:
    """Return what a model fitted to ``train`` is able to tell, as arrays by name.

    ``trend-times`` (N,), those of the first recording, with ``trend-mean`` and ``trend-variance``
    (N, D); ``coregionalisation-parent``, ``coregionalisation-child`` … (Q, D, D), by layer; of a
    latent space of three dimensions ``latent-path-p`` (N_p, 3), ``latent-cloud`` (n, 4), which is
    positions and the confidence there, and ``property-…``; of one with dynamics
    ``latent-mean`` (N, 3), ``latent-sample-i`` (N, 3), and the poses ``walk-mean`` and
    ``walk-sample`` (N, D) of the mean and of the last sample.
    """
    return {
        **_trend(model, train),
        **_coregionalisation(model),
        **_latent_space(model),
        **_latent_walks(model),
    }


def _trend(model: Model, train: Sequence[Recording]) -> Solution:
    if not isinstance(model, Trended):
        return {}
    times = train[0].times
    mean, variance = model.trend(times)
    return {"trend-times": times, "trend-mean": mean, "trend-variance": variance}


def _coregionalisation(model: Model) -> Solution:
    if not isinstance(model, Coregionalised):
        return {}
    matrices = model.coregionalisation_.items()
    return {f"coregionalisation-{layer}": of_layer for layer, of_layer in matrices}


def _latent_space(model: Model) -> Solution:
    if not isinstance(model, Embedded):
        return {}
    paths = model.latent_paths()
    properties = {
        f"property-{name}": np.asarray(value) for name, value in model.kernel_properties_.items()
    }
    if paths[0].shape[1] != N_DIMENSIONS:
        return properties
    box = _box(np.concatenate(paths))
    cloud = np.column_stack([box, model.confidence(box)])
    named = {f"latent-path-{p}": path for p, path in enumerate(paths)}
    return {**properties, **named, "latent-cloud": cloud.astype(np.float32)}


def _box(positions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return points (n, 3) of a regular grid around ``positions`` (N, 3)."""
    low, high = positions.min(axis=0), positions.max(axis=0)
    margin = MARGIN * (high - low)
    sides = [np.linspace(*ends, N_STEPS) for ends in zip(low - margin, high + margin, strict=True)]
    return np.stack(np.meshgrid(*sides, indexing="ij"), axis=-1).reshape(-1, N_DIMENSIONS)


def _latent_walks(model: Model) -> Solution:
    if not isinstance(model, Dynamical) or model.latent_paths()[0].shape[1] != N_DIMENSIONS:
        return {}
    mean, samples = model.latent_walks(N_WALK, N_SAMPLES, random_state=0)
    named = {f"latent-sample-{i}": sample for i, sample in enumerate(samples)}
    walks = {"walk-mean": model.poses(mean), "walk-sample": model.poses(samples[-1])}
    return {"latent-mean": mean, **named, **walks}
