"""Markers: three channels of one name, such as ``LKNE.x``, ``LKNE.y`` and ``LKNE.z``."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Sequence

__all__ = ["is_unlabelled", "markers", "markers_of"]

_COORDINATE = re.compile(r"(.+)[._: -][xyz]", re.IGNORECASE)
_UNLABELLED = re.compile(r"\*\d|unlabelled(-\d+)?\.")


def is_unlabelled(channel: str) -> bool:
    """Return whether it is of a marker that nobody named: ``*12.x``, ``unlabelled-2.x``."""
    return _UNLABELLED.match(channel) is not None


def markers(channels: Sequence[str]) -> dict[str, list[int]]:
    """Return the places of the three channels of each marker, by its name."""
    places: dict[str, list[int]] = defaultdict(list)
    for place, channel in enumerate(channels):
        if found := _COORDINATE.fullmatch(channel):
            places[found[1]].append(place)
    return {marker: three for marker, three in places.items() if len(three) == 3}


def markers_of(channels: Sequence[str]) -> tuple[str, ...]:
    """Return the names of channels, in which one stands for the three channels of a marker.

    Examples
    --------
    >>> from mocapbench.benchmark.filling.markers import markers_of
    >>> markers_of(["LKNE.x", "LKNE.y", "LKNE.z", "RKNE.x", "hip.rx"])
    ('LKNE', 'RKNE.x', 'hip.rx')
    """
    names = {place: marker for marker, three in markers(channels).items() for place in three}
    return tuple(dict.fromkeys(names.get(k, channel) for k, channel in enumerate(channels)))
