"""Latent spaces of three dimensions, and trajectories through them, kept for figures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines import Dynamical, Embedded
from mocapbench.benchmark.problems.arrays import Arrays, arrays_by_number, with_numbers, with_prefix
from mocapbench.datasets import FrameByChannel

__all__ = ["LatentSpace", "LatentWalks", "space_of", "walks_of"]

N_DIMENSIONS = 3
N_STEPS = 14
"""Points of the cloud along each side of the box around the training positions."""
MARGIN = 0.25
"""By how much the box is larger than what it holds, on either side."""
N_WALK, N_SAMPLES = 62, 3
"""Frames of a walk (GPDM §5.1: just less than a gait cycle at 60 Hz), and how many are drawn."""


@dataclass(frozen=True, eq=False)
class LatentSpace:
    """Where training frames lie in a latent space.

    Parameters
    ----------
    properties : mapping of str to ndarray of shape ()
        Properties of the kernels, by name.
    paths : tuple of ndarray, each of shape (N_p, 3)
        Positions of each stretch of training frames; none in other than three dimensions.
    cloud : ndarray of shape (n, 4) or None
        Positions on a grid, and the confidence −ln σ² there.
    """

    properties: Mapping[str, NDArray[np.float64]]
    paths: tuple[NDArray[np.float64], ...] = ()
    cloud: NDArray[np.float32] | None = None

    def to_arrays(self) -> Arrays:
        """Return ``property-…``, ``latent-path-p`` and ``latent-cloud``."""
        properties = {f"property-{name}": value for name, value in self.properties.items()}
        cloud = {} if self.cloud is None else {"latent-cloud": self.cloud}
        return {**properties, **with_numbers("latent-path", self.paths), **cloud}

    @classmethod
    def from_arrays(cls, arrays: Arrays) -> Self | None:
        """Return the space that `to_arrays` turned into ``arrays``, None if there is none."""
        properties = with_prefix("property", arrays)
        space = cls(properties, arrays_by_number("latent-path", arrays), arrays.get("latent-cloud"))
        return space if properties or space.paths else None


@dataclass(frozen=True, eq=False)
class LatentWalks:
    """Trajectories that the dynamics of a latent space give.

    Parameters
    ----------
    mean : ndarray of shape (N, 3)
        The mean prediction from the first training frame.
    samples : tuple of ndarray, each of shape (N, 3)
    mean_poses, sample_poses : ndarray of shape (N, D)
        Poses along the mean and along the last sample.
    """

    mean: NDArray[np.float64]
    samples: tuple[NDArray[np.float64], ...]
    mean_poses: FrameByChannel
    sample_poses: FrameByChannel

    def to_arrays(self) -> Arrays:
        """Return ``latent-mean``, ``latent-sample-i``, ``walk-mean`` and ``walk-sample``."""
        samples = with_numbers("latent-sample", self.samples)
        poses = {"walk-mean": self.mean_poses, "walk-sample": self.sample_poses}
        return {"latent-mean": self.mean, **samples, **poses}

    @classmethod
    def from_arrays(cls, arrays: Arrays) -> Self | None:
        """Return the walks that `to_arrays` turned into ``arrays``, None if there are none."""
        if "latent-mean" not in arrays:
            return None
        samples = arrays_by_number("latent-sample", arrays)
        return cls(arrays["latent-mean"], samples, arrays["walk-mean"], arrays["walk-sample"])


def space_of(model: Embedded) -> LatentSpace:
    """Return the latent space of a fitted model."""
    paths = model.latent_paths()
    properties = {name: np.asarray(value) for name, value in model.kernel_properties_.items()}
    if paths[0].shape[1] != N_DIMENSIONS:
        return LatentSpace(properties)
    box = _box(np.concatenate(paths))
    cloud = np.column_stack([box, model.confidence(box)]).astype(np.float32)
    return LatentSpace(properties, tuple(paths), cloud)


def _box(positions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return points (n, 3) of a regular grid around ``positions`` (N, 3)."""
    low, high = positions.min(axis=0), positions.max(axis=0)
    margin = MARGIN * (high - low)
    sides = [np.linspace(*ends, N_STEPS) for ends in zip(low - margin, high + margin, strict=True)]
    return np.stack(np.meshgrid(*sides, indexing="ij"), axis=-1).reshape(-1, N_DIMENSIONS)


def walks_of(model: Dynamical) -> LatentWalks | None:
    """Return walks through a latent space of three dimensions, None through any other."""
    if model.latent_paths()[0].shape[1] != N_DIMENSIONS:
        return None
    mean, samples = model.latent_walks(N_WALK, N_SAMPLES, random_state=0)
    return LatentWalks(mean, tuple(samples), model.poses(mean), model.poses(samples[-1]))
