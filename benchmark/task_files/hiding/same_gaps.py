"""The gaps of another recording."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.benchmark.task_files.hiding.base import HidingError, HidingPlace, columns_of
from mocapbench.datasets import Mask, Recording, frame_rate
from mocapbench.datasets.formats.sets import same_rate

__all__ = ["SameGaps"]


@dataclass(frozen=True)
class SameGaps:
    """The gaps of another recording, by the names of channels.

    The first fold has them where that recording has them. In the others all move by the same time,
    and what leaves at the end comes in at the beginning.

    Parameters
    ----------
    uri : str
        Address of the other recording, of the same frame rate.
    channels : tuple of str
    """

    uri: str
    channels: tuple[str, ...] = ()

    def mask(self, recording: Recording, place: HidingPlace, /) -> Mask:
        """Return the gaps, moved by the draw of the fold; see `Hiding`."""
        pattern = place.archive.recording(self.uri)
        if not same_rate(recording, pattern):
            expected = f"{frame_rate(recording):.6g} frames per second in {self.uri} too"
            raise HidingError(expected, f"{frame_rate(pattern):.6g}")
        gaps, n_frames = self._gaps(pattern, recording), len(recording.times)
        drawn = place.rng.permutation(len(gaps)) if gaps.any() else ()
        for shift in (0, *drawn) if place.fold == 0 else drawn:
            hidden: Mask = np.roll(gaps, shift, axis=0)[:n_frames] & recording.visible
            if hidden.any():
                return hidden
        raise HidingError(f"gaps of its channels in {self.uri}", "none where it is visible")

    def _gaps(self, pattern: Recording, recording: Recording) -> Mask:
        """Return the gaps (M, D) in the channels of ``recording``, M the longer of the two."""
        n_frames = max(len(pattern.times), len(recording.times))
        gaps = np.zeros((n_frames, len(recording.channels)), dtype=bool)
        for column in columns_of(self.channels, recording):
            name = recording.channels[column]
            if name in pattern.channels:
                lacking = ~pattern.visible[:, pattern.channels.index(name)]
                gaps[: len(lacking), column] = lacking
        return gaps
