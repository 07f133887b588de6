"""Several recordings: their order, and their frames together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Recording

__all__ = [
    "by_name",
    "places_by_name",
    "stack",
    "visible_moments",
]


def by_name(recordings: Sequence[Recording]) -> tuple[Recording, ...]:
    """Return recordings in the order of their names.

    Models learn from them in this order, so that the order in which they are given does not affect
    results: neither rounding nor what is drawn at random depends on it.
    """
    return tuple(sorted(recordings, key=lambda recording: recording.name))


def places_by_name(recordings: Sequence[Recording]) -> NDArray[np.intp]:
    """Return the place (K,) of each of K recordings in `by_name`, their names being distinct.

    Indexed with it, an array of results in the order of names is in the order of ``recordings``.
    """
    places = {recording.name: place for place, recording in enumerate(by_name(recordings))}
    return np.array([places[recording.name] for recording in recordings], dtype=np.intp)


def stack(recordings: Sequence[Recording]) -> FrameByChannel:
    """Return the values of all recordings, stacked along frames: (ΣN, D)."""
    return np.concatenate([recording.values for recording in recordings])


def visible_moments(recordings: Sequence[Recording]) -> tuple[Array, Array]:
    """Return the mean and variance (ddof 0) of each channel's visible entries: (D,) each.

    They are NaN where a channel has none.
    """
    values = stack(recordings)
    seen = ~np.isnan(values)
    counts = np.where(seen.any(axis=0), seen.sum(axis=0), np.nan)
    mean = np.where(seen, values, 0.0).sum(axis=0) / counts
    variance = np.where(seen, (values - mean) ** 2, 0.0).sum(axis=0) / counts
    return mean, variance
