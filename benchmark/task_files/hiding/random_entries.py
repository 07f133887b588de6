"""A share of the visible entries."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.benchmark.task_files.hiding.base import HidingPlace, columns_of
from mocapbench.datasets import Mask, Recording

__all__ = ["RandomEntries"]


@dataclass(frozen=True)
class RandomEntries:
    """A share of the visible entries of some channels, each drawn by itself.

    Parameters
    ----------
    share : float
        Between 0 and 1.
    channels : tuple of str
    """

    share: float
    channels: tuple[str, ...] = ()

    def mask(self, recording: Recording, place: HidingPlace, /) -> Mask:
        """Return a draw of the fold; see `Hiding`."""
        eligible = np.zeros(recording.values.shape, dtype=bool)
        eligible[:, columns_of(self.channels, recording)] = True
        entries = np.flatnonzero(eligible & recording.visible)
        chosen = place.rng.permutation(entries)[: round(self.share * len(entries))]
        hidden = np.zeros(recording.values.size, dtype=bool)
        hidden[chosen] = True
        return hidden.reshape(recording.values.shape)
