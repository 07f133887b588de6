"""Gaps filled by each channel's own course, from the frames beside them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.kriging.own_course import own_course
from mocapbench.basics.arrays import Array
from mocapbench.basics.gaps import hidden_together, runs
from mocapbench.datasets import FrameByChannel, Mask

__all__ = ["courses"]


_BESIDE = 100
"""Frames on both sides of a gap from which it is filled."""
_LEAST = 1e-12
"""The least scale of a channel's variance, relative to its mean square beside the gap."""


def courses(
    values: FrameByChannel, wanted: Mask
) -> Iterator[tuple[tuple[NDArray[np.intp], ...], Array, Array]]:
    """Yield places in an array (N, D), with the mean and the variance there.

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
            least = _LEAST * max(float(np.nanmean(beside**2)), np.finfo(np.float64).tiny)
            mean, variance = own_course(beside, visible, least)
            inside = gap - near[0]
            yield np.ix_(gap, columns), mean[inside], variance[inside]
