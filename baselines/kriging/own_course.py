"""What is to be expected of a recording from its own visible frames alone.

Each channel is a constant plus a Gaussian process over time with the once differentiable kernel
of Matérn. Its scale and its lengthscale are inferred from the visible frames of the channel.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.prior.kernels import Matern32
from mocapbench.baselines.kriging.conditioned import ConditionedFrames
from mocapbench.datasets import FrameByChannel

__all__ = ["own_course"]

_LENGTHSCALES = 2.0 ** np.arange(2.0, 7.0, 0.5)
"""In frames; all are equally probable before anything is seen."""
_CONSTANT, _NOISE = 10.0, 1e-4
"""Prior variances of the constant and of the noise, up to scale."""


def own_course(
    values: FrameByChannel, visible: NDArray[np.bool_], least: float
) -> tuple[FrameByChannel, FrameByChannel]:
    """Return the predictive mean and variance (N, D) of all frames given the visible ones.

    Lengthscales are averaged over, with weights by their evidence in the channel.

    Parameters
    ----------
    values : ndarray of shape (N, D)
        Those of hidden frames are not read.
    visible : ndarray of bool, shape (N,)
        Which frames are visible; at least one.
    least : float
        Least scale of a channel's variance, positive.
    """
    centre = values[visible].mean(axis=0)
    parts = [_with(length, values[visible] - centre, visible, least) for length in _LENGTHSCALES]
    means, variances, evidence = map(np.array, zip(*parts, strict=True))
    weights = np.exp(evidence - evidence.max(axis=0))
    weights = (weights / weights.sum(axis=0))[:, None]
    mean = (weights * means).sum(axis=0)
    return centre + mean, (weights * (variances + (means - mean) ** 2)).sum(axis=0)


def _with(
    lengthscale: float, residuals: FrameByChannel, visible: NDArray[np.bool_], least: float
) -> tuple[FrameByChannel, FrameByChannel, NDArray[np.float64]]:
    """Return mean and variance (N, D) with one lengthscale, and its evidence (D,)."""
    times = np.arange(len(visible), dtype=np.float64)
    course = Matern32().value(np.subtract.outer(times, times), float(lengthscale))
    given = ConditionedFrames(_CONSTANT + course, _NOISE, visible, np.empty((len(times), 0)))
    scales = given.scales(residuals, least)
    variance = given.doubt_of_scale * np.outer(given.variance, scales)
    return given.mean(residuals), variance, given.log_evidence(scales)
