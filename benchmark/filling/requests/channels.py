"""Which channels of a recording the user names: by names, or by patterns as those of a shell."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from fnmatch import fnmatchcase

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.requests.names import name_owners
from mocapbench.benchmark.filling.requests.refusals import explain_no_channel
from mocapbench.datasets import Recording
from mocapbench.datasets.formats.strays import find_unmeasured

__all__ = ["match_channels", "match_pattern"]


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
    return np.any(matches, axis=0)


def match_pattern(channels: Sequence[str], pattern: str) -> NDArray[np.bool_]:
    """Return which channels (D,) match a pattern themselves, or by their marker or joint.

    Examples
    --------
    >>> from mocapbench.benchmark.filling.requests.channels import match_pattern
    >>> channels = ["C7.x", "C7.y", "C7.z", "hip.rx", "hip.ry"]
    >>> match_pattern(channels, "C7").tolist()
    [True, True, True, False, False]
    >>> match_pattern(channels, "*.ry").tolist()
    [False, False, False, False, True]
    """
    pairs = zip(channels, name_owners(channels), strict=True)
    return np.array(
        [any(fnmatchcase(name, pattern) for name in pair) for pair in pairs], dtype=bool
    )
