"""Stated frames of some channels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.benchmark.task_files.hiding.base import HidingError, HidingPlace, columns_of
from mocapbench.benchmark.task_files.selection import Span
from mocapbench.datasets import Mask, Recording

__all__ = ["Spans"]


@dataclass(frozen=True)
class Spans:
    """Stated frames of some channels.

    Parameters
    ----------
    spans : tuple of Span
    channels : tuple of str
        Regular expressions; none stands for all channels.
    """

    spans: tuple[Span, ...]
    channels: tuple[str, ...] = ()

    def mask(self, recording: Recording, place: HidingPlace, /) -> Mask:
        """Return the same entries in every fold; see `Hiding`."""
        del place
        n_frames = len(recording.times)
        for span in self.spans:
            if not span.within(n_frames):
                raise HidingError(
                    f"frames within its {n_frames}", f"{span.start}:{span.stop or ''}"
                )
        hidden = np.zeros(recording.values.shape, dtype=bool)
        for span in self.spans:
            hidden[span.slice, columns_of(self.channels, recording)] = True
        return hidden & recording.visible
