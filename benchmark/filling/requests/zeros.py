"""Zeros that may stand for missing values: a marker that is at the origin for some frames."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.common.markers import markers_of
from mocapbench.basics.words import format_count, join_names
from mocapbench.datasets import Recording

__all__ = ["describe_zeros"]

_NAMED = 4
"""Markers that the caution names at most."""


def describe_zeros(recording: Recording) -> str:
    """Return which markers are at the origin in some frames and elsewhere in others, if any."""
    zeros = _count_zeros(recording)
    if not zeros:
        return ""
    are, each = ("is", "") if len(zeros) == 1 else ("are", "up to ")
    return (
        f"{join_names([*zeros], _NAMED)} {are} exactly 0, 0, 0 in {each}"
        f"{format_count(max(zeros.values()), 'frame')} and elsewhere in others: if that marks "
        "missing values, empty these cells."
    )


def _count_zeros(recording: Recording) -> dict[str, int]:
    """Return in how many frames each such marker is at the origin."""
    counts = {}
    for marker, axes in markers_of(recording.channels, recording.units).items():
        values = recording.values[:, list(axes)]
        n_zeros = int((values == 0.0).all(axis=1).sum())
        if n_zeros and (np.nan_to_num(values) != 0.0).any():
            counts[marker] = n_zeros
    return counts
