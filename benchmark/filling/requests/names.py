"""What messages call channels: markers by their names."""

from __future__ import annotations

from collections.abc import Sequence

from mocapbench.baselines.common.markers import markers_of

__all__ = ["marker_names"]


def marker_names(channels: Sequence[str]) -> tuple[str, ...]:
    """Return the names of channels, in which one stands for the three channels of a marker.

    Examples
    --------
    >>> from mocapbench.benchmark.filling.requests.names import marker_names
    >>> marker_names(["LKNE.x", "LKNE.y", "LKNE.z", "RKNE.x", "hip.rx"])
    ('LKNE', 'RKNE.x', 'hip.rx')
    """
    found = markers_of(channels, [""] * len(channels))
    names = {place: marker for marker, places in found.items() for place in places}
    return tuple(dict.fromkeys(names.get(place, name) for place, name in enumerate(channels)))
