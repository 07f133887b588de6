"""What channels are called: by the names of markers and joints, or by patterns."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fnmatch import fnmatchcase
from functools import lru_cache

import numpy as np

from mocapbench.baselines.common.markers import markers_of
from mocapbench.benchmark.filling.gaps import Gap
from mocapbench.datasets import Mask

__all__ = ["match_pattern", "name_hidden_markers", "name_markers", "name_owners", "split_names"]


def name_markers(channels: Sequence[str]) -> tuple[str, ...]:
    """Return the names of channels, in which one stands for the three channels of a marker.

    Examples
    --------
    >>> from mocapbench.benchmark.filling.requests.names import name_markers
    >>> name_markers(["LKNE.x", "LKNE.y", "LKNE.z", "RKNE.x", "hip.rx"])
    ('LKNE', 'RKNE.x', 'hip.rx')
    """
    names = _find_markers(channels)
    return tuple(dict.fromkeys(names.get(k, name) for k, name in enumerate(channels)))


def name_owners(channels: Sequence[str]) -> tuple[str, ...]:
    """Return the marker or joint of each channel (D,), or its own name if it is of none.

    Examples
    --------
    >>> from mocapbench.benchmark.filling.requests.names import name_owners
    >>> name_owners(["LKNE.x", "LKNE.y", "LKNE.z", "RKNE_x", "hip.rx"])
    ('LKNE', 'LKNE', 'LKNE', 'RKNE_x', 'hip')
    """
    return _find_owners(tuple(channels))


@lru_cache(maxsize=8)
def _find_owners(channels: tuple[str, ...]) -> tuple[str, ...]:
    names = _find_markers(channels)
    stems = (name.rpartition(".")[0] or name for name in channels)
    return tuple(names.get(k, stem) for k, stem in enumerate(stems))


def match_pattern(channels: Sequence[str], pattern: str) -> Mask:
    """Return which channels (D,) match a pattern themselves, or by their marker or joint.

    Examples
    --------
    >>> from mocapbench.benchmark.filling.requests.names import match_pattern
    >>> channels = ["C7.x", "C7.y", "C7.z", "hip.rx", "hip.ry"]
    >>> match_pattern(channels, "C7").tolist()
    [True, True, True, False, False]
    >>> match_pattern(channels, "*.ry").tolist()
    [False, False, False, False, True]
    """
    return _match_names(tuple(channels), pattern).copy()


@lru_cache(maxsize=512)  # thousands of gaps may be of a few hundred markers
def _match_names(channels: tuple[str, ...], pattern: str) -> Mask:
    pairs = zip(channels, name_owners(channels), strict=True)
    return np.array(
        [any(fnmatchcase(name, pattern) for name in pair) for pair in pairs], dtype=bool
    )


def _find_markers(channels: Sequence[str]) -> dict[int, str]:
    """Return the marker of each channel that is one of its three."""
    found = markers_of(channels, [""] * len(channels))
    return {k: marker for marker, channels_of in found.items() for k in channels_of}


def split_names(texts: Iterable[str]) -> tuple[str, ...]:
    """Return the names that texts list, each with commas between, without empty parts.

    Examples
    --------
    >>> from mocapbench.benchmark.filling.requests.names import split_names
    >>> split_names(["LKNE, R*", "C7"])
    ('LKNE', 'R*', 'C7')
    """
    parts = (part.strip() for text in texts for part in text.split(","))
    return tuple(filter(None, parts))


def name_hidden_markers(channels: Sequence[str], gaps: Iterable[Gap]) -> tuple[str, ...]:
    """Return the names of the markers that gaps hide."""
    hidden = sorted({channel for gap in gaps for channel in gap.channels})
    return name_markers([channels[channel] for channel in hidden])
