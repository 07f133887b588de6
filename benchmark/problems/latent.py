"""Latent spaces of three dimensions, and trajectories through them, kept for figures."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines import Dynamical, Embedded
from mocapbench.benchmark.problems.arrays import Arrays, with_numbers

__all__ = ["space_of", "walks_of"]

N_DIMENSIONS = 3
N_STEPS = 14
"""Points of the cloud along each side of the box around the training positions."""
MARGIN = 0.25
"""By how much the box is larger than what it holds, on either side."""
N_WALK, N_SAMPLES = 62, 3
"""Frames of a walk (GPDM §5.1: just less than a gait cycle at 60 Hz), and how many are drawn."""


def space_of(model: Embedded) -> Arrays:
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


def walks_of(model: Dynamical) -> Arrays:
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
