"""What messages call channels: markers by their names."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache

from mocapbench.baselines.common.markers import markers_of
from mocapbench.benchmark.filling.gaps import Gap

__all__ = ["name_hidden_markers", "name_markers", "name_owners"]


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


def _find_markers(channels: Sequence[str]) -> dict[int, str]:
    """Return the marker of each channel that is one of its three."""
    found = markers_of(channels, [""] * len(channels))
    return {k: marker for marker, channels_of in found.items() for k in channels_of}


def name_hidden_markers(channels: Sequence[str], gaps: Iterable[Gap]) -> tuple[str, ...]:
    """Return the names of the markers that gaps hide."""
    hidden = sorted({channel for gap in gaps for channel in gap.channels})
    return name_markers([channels[channel] for channel in hidden])
