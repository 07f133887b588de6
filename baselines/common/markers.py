"""Which channels are the coordinates of markers or joints."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

__all__ = ["markers_of"]


def markers_of(channels: Sequence[str]) -> NDArray[np.intp]:
    """Return the places of the coordinates of each marker among channels (M, 3).

    Those of a marker are named ``LKNE.x``, ``LKNE.y`` and ``LKNE.z``, as those of markers in C3D
    and TRC files, and of joints in `mocapbench.datasets.joint_trajectories`.

    Examples
    --------
    >>> markers_of(("time", "LKNE.x", "LKNE.z", "LKNE.y", "LANK.x"))
    array([[1, 3, 2]])
    """
    places = {channel: place for place, channel in enumerate(channels)}
    names = dict.fromkeys(channel.removesuffix(".x") for channel in channels)
    found = [[places.get(f"{name}.{axis}", -1) for axis in "xyz"] for name in names]
    return np.array([each for each in found if min(each) >= 0], dtype=np.intp).reshape(-1, 3)
