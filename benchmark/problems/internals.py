"""Fitted quantities of a model besides its solution, kept for figures.

They are a trend, matrices of coregionalisation, and of a latent space of three dimensions the
positions of frames and walks through it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.problems.arrays import Arrays, with_numbers
from mocapbench.datasets import Frames, Recording

if TYPE_CHECKING:
    from mocapbench.baselines import Dynamical, Embedded, Trended

__all__ = ["internals_of"]

N_DIMENSIONS = 3
"""Of a latent space that is drawn."""
N_STEPS = 14
"""Points of the cloud along each side of the box around the training positions."""
MARGIN = 0.25
"""By how much the box is larger than what it holds, on either side."""
N_WALK, N_SAMPLES = 62, 3
"""Frames of a walk (GPDM §5.1: just less than a gait cycle at 60 Hz), and how many are drawn."""


def internals_of(model: Any, train: Sequence[Recording]) -> Arrays:
    """Return what a model fitted to ``train`` has.

    Returns
    -------
    mapping of str to ndarray
        The mean and variance (N, D) of a trend, ``trend-mean`` and ``trend-variance``, at the first
        recording's times, ``trend-times`` (N,); the matrices B_q of each layer (Q, D, D), as
        ``coregionalisation-layer``; and what `_embed_training` and `_predict_walks` return.
    """
    arrays: dict[str, Any] = {}
    if "has coregionalisation" in model.provides:
        layers = model.coregionalisation_.items()
        arrays |= {f"coregionalisation-{layer}": matrices for layer, matrices in layers}
    if "has a trend" in model.provides:
        arrays |= _infer_trend(model, train[0].times)
    if "has a latent space" in model.provides:
        arrays |= _embed_training(model)
    if "has latent dynamics" in model.provides:
        arrays |= _predict_walks(model)
    return arrays


def _infer_trend(model: Trended, times: Frames) -> Arrays:
    mean, variance = model.trend(times)
    return {"trend-times": times, "trend-mean": mean, "trend-variance": variance}


def _embed_training(model: Embedded) -> Arrays:
    """Return where training frames lie in the latent space of a fitted model.

    ``property-…`` () are the properties of its kernels, by name. In three dimensions there are
    ``latent-path-p`` (N_p, 3), the positions of each stretch of training frames, and
    ``latent-cloud`` (n, 4), positions on a grid and the confidence −ln σ² there.
    """
    paths = model.latent_paths()
    properties = {
        f"property-{name}": np.asarray(value) for name, value in model.kernel_properties_.items()
    }
    if paths[0].shape[1] != N_DIMENSIONS:
        return properties
    box = _box(np.concatenate(paths))
    cloud = np.column_stack([box, model.confidence(box)]).astype(np.float32)
    return {**properties, **with_numbers("latent-path", paths), "latent-cloud": cloud}


def _box(positions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return points (n, 3) of a regular grid around ``positions`` (N, 3)."""
    low, high = positions.min(axis=0), positions.max(axis=0)
    margin = MARGIN * (high - low)
    sides = [np.linspace(*ends, N_STEPS) for ends in zip(low - margin, high + margin, strict=True)]
    return np.stack(np.meshgrid(*sides, indexing="ij"), axis=-1).reshape(-1, N_DIMENSIONS)


def _predict_walks(model: Dynamical) -> Arrays:
    """Return walks through a latent space of three dimensions, nothing of any other.

    ``latent-mean`` (N, 3) is the mean prediction from the first training frame, ``latent-sample-i``
    (N, 3) are samples; ``walk-mean`` and ``walk-sample`` (N, D) are the poses along the mean and
    along the last sample.
    """
    if model.latent_paths()[0].shape[1] != N_DIMENSIONS:
        return {}
    mean, samples = model.latent_walks(N_WALK, N_SAMPLES, random_state=0)
    poses = {"walk-mean": model.poses(mean), "walk-sample": model.poses(samples[-1])}
    return {"latent-mean": mean, **with_numbers("latent-sample", samples), **poses}
