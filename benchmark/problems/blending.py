"""A passage from one style to another (HLM §4.2, Figure 3)."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines import Blender
from mocapbench.benchmark.problems.base import InvalidPredictionError, Solution

__all__ = ["N_FRAMES", "passage"]

N_FRAMES = 75
"""Two and a half seconds at 30 Hz: two cycles of a walk, or so."""

Array = NDArray[np.float64]


def passage(model: Blender, labels: NDArray[np.intp], n_channels: int) -> Solution:
    """Return a passage between the two styles that differ most, and either style by itself.

    Returns
    -------
    mapping
        ``blend`` (3, N, D): the first style, the passage and the second style, on the same states
        of the cycle; ``blended`` (2,): the clusters that these styles are. Empty if all recordings
        are in one cluster.

    Raises
    ------
    InvalidPredictionError
        If the model does not answer with finite frames of the recordings' channels.
    """
    used = np.unique(labels)
    if len(used) < 2:
        return {}
    alone = {
        style: np.tile(np.arange(model.get_params()["n_styles"]) == style, (N_FRAMES, 1)) * 1.0
        for style in used
    }
    pure = {style: _blended(model, weights, n_channels) for style, weights in alone.items()}
    first, second = max(
        combinations(used, 2), key=lambda pair: float(((pure[pair[0]] - pure[pair[1]]) ** 2).sum())
    )
    share = (0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, N_FRAMES)))[:, None]
    between = _blended(model, (1.0 - share) * alone[first] + share * alone[second], n_channels)
    return {
        "blend": np.stack([pure[first], between, pure[second]]),
        "blended": np.array([first, second]),
    }


def _blended(model: Blender, weights: Array, n_channels: int) -> Array:
    motion = np.asarray(model.blend(weights), dtype=np.float64)
    if motion.shape != (N_FRAMES, n_channels) or not np.isfinite(motion).all():
        raise InvalidPredictionError(
            f"blend: expected finite frames of shape {(N_FRAMES, n_channels)}, got {motion.shape} "
            f"with {int((~np.isfinite(motion)).sum())} entries that are NaN or infinite"
        )
    return motion
