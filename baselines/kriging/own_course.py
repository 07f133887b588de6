"""What is to be expected of a recording from its own visible frames alone.

Each channel is a constant plus a Gaussian process over time with the once differentiable kernel
of Matérn. Its scale and its lengthscale are inferred from the visible frames of the channel. Motion
is less regular than such a process: where visible stretches as long as the gaps, each told from all
else, err further than expected, the variance grows likewise.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.gp.prior.kernels import Matern32
from mocapbench.baselines.kriging.conditioned import (
    ConditionedFrames,
    copy_gaps,
    growth_of_variance,
)
from mocapbench.basics.arrays import Array, Index
from mocapbench.basics.mask_runs import hidden_together, runs
from mocapbench.datasets import FrameByChannel, Mask

__all__ = ["courses_in_gaps", "own_course"]

_LENGTHSCALES = 2.0 ** np.arange(2.0, 7.0, 0.5)
"""In frames; all are equally probable before anything is seen."""
_CONSTANT, _NOISE = 10.0, 1e-4
"""Prior variances of the constant and of the noise, up to scale."""
_BESIDE = 100
"""Frames on both sides of a gap from which it is filled."""
_LEAST_SCALE = 1e-12
"""The least scale of a channel's variance, relative to its mean square beside the gap."""


def own_course(
    values: FrameByChannel, visible: NDArray[np.bool_], least: float
) -> tuple[FrameByChannel, FrameByChannel]:
    """Return the predictive mean and variance (N, D) of all frames given the visible ones.

    Lengthscales are averaged over, with weights by their evidence in the channel. The variance of
    all channels grows by the ratio of squared errors to their variances in stretches left out,
    where that is above 1.

    Parameters
    ----------
    values : ndarray of shape (N, D)
        Those of hidden frames are not read.
    visible : ndarray of bool, shape (N,)
        Which frames are visible; at least one.
    least : float
        Least scale of a channel's variance, positive.
    """
    centre, copies = values[visible].mean(axis=0), copy_gaps(visible)
    residuals = values[visible] - centre
    parts = [_fill_with(each, residuals, visible, least, copies) for each in _LENGTHSCALES]
    means, variances, evidence, left_out = map(np.array, zip(*parts, strict=True))
    # Of the mixture: the mean of the means, and the mean variance plus the variance of means.
    weights = np.exp(evidence - evidence.max(axis=0))
    weights = (weights / weights.sum(axis=0))[:, None]
    mean = (weights * means).sum(axis=0)
    variance = (weights * (variances + (means - mean) ** 2)).sum(axis=0)
    return centre + mean, variance * growth_of_variance((weights * left_out).sum(axis=0))


def courses_in_gaps(
    values: FrameByChannel, wanted: Mask
) -> Iterator[tuple[tuple[NDArray[np.intp], ...], Array, Array]]:
    """Yield the entries of gaps, as an index into an array (N, D), with their mean and variance.

    Nothing is yielded of gaps with fewer than two visible frames beside them.

    Parameters
    ----------
    values : ndarray of shape (N, D)
        NaN where hidden.
    wanted : ndarray of bool, shape (N, D)
        Hidden entries that are to be filled.
    """
    hidden = np.isnan(values)
    for columns in hidden_together(np.concatenate([wanted, hidden])):
        for gap in runs(wanted[:, columns[0]]):
            near = np.arange(max(gap[0] - _BESIDE, 0), min(gap[-1] + _BESIDE + 1, len(values)))
            visible = ~hidden[near, columns[0]]
            if visible.sum() < 2:
                continue
            beside = values[np.ix_(near, columns)]
            least = _LEAST_SCALE * max(float(np.nanmean(beside**2)), np.finfo(np.float64).tiny)
            mean, variance = own_course(beside, visible, least)
            inside = gap - near[0]
            yield np.ix_(gap, columns), mean[inside], variance[inside]


def _fill_with(
    lengthscale: float,
    residuals: FrameByChannel,
    visible: NDArray[np.bool_],
    least: float,
    copies: Sequence[Index],
) -> tuple[FrameByChannel, FrameByChannel, Array, Array]:
    """Return mean and variance (N, D) with one lengthscale, its evidence (D,), and errors (2, D).

    Errors are sums of squares and of their variances in copies of the gaps.
    """
    times = np.arange(len(visible), dtype=np.float64)
    course = Matern32().value(np.subtract.outer(times, times), float(lengthscale))
    given = ConditionedFrames(_CONSTANT + course, _NOISE, visible, np.empty((len(times), 0)))
    scales = given.scales(residuals, least)
    left_out = given.leave_out(copies, residuals, scales)
    return given.mean(residuals), given.variances(scales), given.log_evidence(scales), left_out
