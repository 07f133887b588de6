"""What messages call channels: markers by their names, and which markers have none."""

from __future__ import annotations

import re
from collections.abc import Sequence

from mocapbench.baselines.common.markers import markers_of

__all__ = ["is_unlabelled", "marker_names"]

_UNLABELLED = re.compile(r"\*\d|unlabelled(-\d+)?\.")


def is_unlabelled(channel: str) -> bool:
    """Return whether it is of a marker that nobody named: ``*12.x``, ``unlabelled-2.x``."""
    return _UNLABELLED.match(channel) is not None


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
