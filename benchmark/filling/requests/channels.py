"""Which channels of a recording the user names."""

from __future__ import annotations

import re
from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.errors import UsageError
from mocapbench.datasets import Recording
from mocapbench.datasets.formats.strays import find_unmeasured

__all__ = ["match_channels"]


def match_channels(
    recording: Recording, pattern: str | None, results: Collection[str]
) -> NDArray[np.bool_]:
    """Return which channels (D,) a regular expression matches.

    Without one, they are all that are of labelled markers, not results of a model of the body.

    Raises
    ------
    UsageError
        If it is not a regular expression, or matches no channel.
    """
    if pattern is None:
        others = find_unmeasured(recording.channels, results)
        return np.array([name not in others for name in recording.channels], dtype=bool)
    matches = np.array([_matches(pattern, name) for name in recording.channels], dtype=bool)
    if not matches.any():
        some = ", ".join(recording.channels[:5])
        raise UsageError(
            f"{recording.name}: expected --channels to match a channel, got {pattern!r}; "
            f"its {len(recording.channels)} channels begin with {some}; "
            "the pattern must match a whole name, such as 'lfemur.*'"
        )
    return matches


def _matches(pattern: str, name: str) -> bool:
    try:
        return re.fullmatch(pattern, name) is not None
    except re.error as error:
        raise UsageError(
            f"--channels: expected a regular expression, got {pattern!r} ({error}); "
            "write such as 'lfemur.*'"
        ) from error
