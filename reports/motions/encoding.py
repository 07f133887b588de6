"""Positions as text: 16-bit integers, as differences that compress well.

The steps, which the page's script undoes in reverse:

1. Positions become multiples of the resolution, in 16-bit integers; sums wrap around.
2. A motion is stated as its difference from the truth that it is compared with: 0 where a model
   returned what it saw.
3. A joint is stated as its difference from its parent: bones move less than hands.
4. A value is stated as its difference from the frame before.
5. Differences d of either sign become 2 d or −2 d − 1, so that small ones have a zero high byte.
6. All low bytes stand before all high bytes, compressed by zlib, in base64.
"""

from __future__ import annotations

import zlib
from base64 import b64encode

import numpy as np
from numpy.typing import NDArray

from mocapbench.reports.bundle.pictures import Motions

__all__ = ["FINEST", "encode", "quantise_positions", "resolution"]

FINEST = 0.1
"""Centimetres. Markers are measured to about a millimetre."""
_LARGEST = 32767

Quantised = NDArray[np.int16]


def resolution(picture: Motions) -> float:
    """Return the centimetres of one step: `FINEST`, or more where positions go farther."""
    arrays = (*picture.truths.values(), *picture.motions.values())
    return max(FINEST, max(float(np.abs(array).max()) for array in arrays) / _LARGEST)


def quantise_positions(picture: Motions) -> Quantised:
    """Return truths and motions (M, T, J, 3), one after another, in steps of `resolution`."""
    arrays = [*picture.truths.values(), *picture.motions.values()]
    return np.round(np.stack(arrays) / resolution(picture)).astype(np.int16)


def encode(picture: Motions) -> str:
    """Return positions as text, in steps of `resolution`."""
    steps = quantise_positions(picture)
    names = list(picture.truths)
    against = [names.index(picture.truth_of(label)) for label in picture.motions]
    steps[len(names) :] -= steps[against]
    return _compress_differences(_time_differences(_bones(steps, picture.parents)))


def _bones(steps: Quantised, parents: tuple[int, ...]) -> Quantised:
    """Return joints relative to their parents, a joint without one as it is."""
    bones = steps.copy()
    for joint, parent in enumerate(parents):
        if parent >= 0:
            bones[:, :, joint] -= steps[:, :, parent]
    return bones


def _time_differences(steps: Quantised) -> Quantised:
    """Return the changes from frame to frame, from 0 on, as (M, J, 3, T)."""
    by_time = np.moveaxis(steps, 1, -1)
    return np.diff(by_time, axis=-1, prepend=np.zeros_like(by_time[..., :1]))


def _compress_differences(differences: Quantised) -> str:
    wide = differences.astype(np.int32)
    unsigned = (np.where(wide < 0, -2 * wide - 1, 2 * wide)).astype("<u2")
    planes = np.frombuffer(unsigned.tobytes(), dtype=np.uint8).reshape(-1, 2).T
    return b64encode(zlib.compress(planes.tobytes(), level=6)).decode()
