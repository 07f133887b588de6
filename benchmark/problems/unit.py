"""Units of measurement in which scores are taken."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets import FrameByChannel

__all__ = ["Unit"]


@dataclass(frozen=True, eq=False)
class Unit:
    """An affine unit of measurement per channel.

    Parameters
    ----------
    offset, scale : ndarray of shape (D,)
        A value y is scored as (y − offset) / scale.
    """

    offset: NDArray[np.float64]
    scale: NDArray[np.float64]

    @classmethod
    def natural(cls, n_channels: int) -> Unit:
        """Return the channels' own units."""
        return cls(np.zeros(n_channels), np.ones(n_channels))

    @classmethod
    def range_of(cls, values: FrameByChannel) -> Unit:
        """Return the unit in which complete ``values`` (N, D) range from 0 to 1."""
        low = values.min(axis=0)
        return cls(low, values.max(axis=0) - low)

    def names(self, own: Sequence[str]) -> tuple[str, ...]:
        """Return the channels' ``own`` units (D,); nothing where a channel is scored in another."""
        kept = (self.offset == 0.0) & (self.scale == 1.0)
        return tuple(name if same else "" for name, same in zip(own, kept, strict=True))

    def of(self, values: FrameByChannel) -> FrameByChannel:
        """Return ``values`` (N, D) in this unit."""
        return (values - self.offset) / self.scale
