"""A transition from one style to another, as part of a solution.

After Pan and Torresani 2009 (HLM), §4.2 and Figure 3.
"""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.problems.arrays import Arrays
from mocapbench.benchmark.problems.base import InvalidPredictionError
from mocapbench.datasets import FrameByChannel

if TYPE_CHECKING:
    from mocapbench.baselines import Blender

__all__ = ["N_FRAMES", "blend_of"]

N_FRAMES = 75
"""Two and a half seconds at 30 Hz: two cycles of a walk, or so."""


def blend_of(model: Blender, labels: NDArray[np.intp], n_channels: int) -> Arrays | None:
    """Return a transition between the two styles that differ most; None if all are in one cluster.

    It is ``blend`` (3, N, D), the first style, the transition and the second style on the same
    states of the cycle, and ``blended`` (2,), the clusters that are the styles.

    Raises
    ------
    InvalidPredictionError
        If the model does not return finite frames of the recordings' channels.
    """
    used = np.unique(labels).tolist()
    if len(used) < 2:
        return None
    alone = {style: np.tile(np.eye(model.n_styles)[style], (N_FRAMES, 1)) for style in used}
    pure = {style: _blend_styles(model, weights, n_channels) for style, weights in alone.items()}
    first, second = max(
        combinations(used, 2), key=lambda pair: float(((pure[pair[0]] - pure[pair[1]]) ** 2).sum())
    )
    share = (0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, N_FRAMES)))[:, None]
    weights = (1.0 - share) * alone[first] + share * alone[second]
    between = _blend_styles(model, weights, n_channels)
    motions = np.stack([pure[first], between, pure[second]])
    return {"blend": motions, "blended": np.array([first, second])}


def _blend_styles(model: Blender, weights: NDArray[np.float64], n_channels: int) -> FrameByChannel:
    motion = np.asarray(model.blend(weights), dtype=np.float64)
    if motion.shape != (N_FRAMES, n_channels) or not np.isfinite(motion).all():
        raise InvalidPredictionError(
            f"blend: expected finite frames of shape {(N_FRAMES, n_channels)}, got {motion.shape} "
            f"with {int((~np.isfinite(motion)).sum())} entries that are NaN or infinite"
        )
    return motion
