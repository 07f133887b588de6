"""Markers and their coordinates as channels."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

__all__ = ["marker_channels"]


def marker_channels(labels: Iterable[str]) -> tuple[str, ...]:
    """Return the channels of markers: ``LKNE.x``, ``LKNE.y``, ``LKNE.z`` and so on.

    A label that another marker has before gets a number, as files of unlabelled trajectories repeat
    theirs; no label at all becomes ``unlabelled``.

    Examples
    --------
    >>> from mocapbench.datasets.formats.markers.channels import marker_channels
    >>> marker_channels(["LKNE", "", ""])[::3]
    ('LKNE.x', 'unlabelled.x', 'unlabelled-2.x')
    """
    seen: Counter[str] = Counter()
    names = []
    for label in labels:
        name = label.strip() or "unlabelled"
        seen[name] += 1
        names.append(f"{name}-{seen[name]}" if seen[name] > 1 else name)
    return tuple(f"{name}.{axis}" for name in names for axis in "xyz")
