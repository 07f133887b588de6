"""What messages call channels: markers by their names."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from mocapbench.baselines.common.markers import markers_of
from mocapbench.benchmark.filling.gaps import Gap

__all__ = ["name_hidden_markers", "name_markers"]


def name_markers(channels: Sequence[str]) -> tuple[str, ...]:
    """Return the names of channels, in which one stands for the three channels of a marker.

    Examples
    --------
    >>> from mocapbench.benchmark.filling.requests.names import name_markers
    >>> name_markers(["LKNE.x", "LKNE.y", "LKNE.z", "RKNE.x", "hip.rx"])
    ('LKNE', 'RKNE.x', 'hip.rx')
    """
    found = markers_of(channels, [""] * len(channels))
    names = {k: marker for marker, channels_of in found.items() for k in channels_of}
    return tuple(dict.fromkeys(names.get(k, name) for k, name in enumerate(channels)))


def name_hidden_markers(channels: Sequence[str], gaps: Iterable[Gap]) -> tuple[str, ...]:
    """Return the names of the markers that gaps hide."""
    hidden = sorted({channel for gap in gaps for channel in gap.channels})
    return name_markers([channels[channel] for channel in hidden])
