"""Which channels of a recording the user names: by names, or by patterns as those of a shell."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.requests.names import match_pattern
from mocapbench.benchmark.filling.requests.refusals import explain_no_channel
from mocapbench.datasets import Recording
from mocapbench.datasets.formats.strays import find_unmeasured

__all__ = ["match_channels"]


def match_channels(
    recording: Recording, patterns: Sequence[str], results: Collection[str]
) -> NDArray[np.bool_]:
    """Return which channels (D,) any of some patterns match.

    Without one, they are all that are of labelled markers, not results of a model of the body.

    Raises
    ------
    UsageError
        If a pattern matches no channel.
    """
    if not patterns:
        others = find_unmeasured(recording.channels, results)
        return np.array([name not in others for name in recording.channels], dtype=bool)
    matches = [match_pattern(recording.channels, pattern) for pattern in patterns]
    for pattern, of_one in zip(patterns, matches, strict=True):
        if not of_one.any():
            said = explain_no_channel(recording.channels, pattern)
            raise UsageError(f"{recording.name}: --channels: {said}")
    return np.asarray(np.any(matches, axis=0))
