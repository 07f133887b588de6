"""Which channels are results of a model of the body, not markers, by their names.

Plug-in Gait puts them beside the markers, and not all of its files say which they are: origin and
axes of each segment (LFEO, LFEA, LFEL, LFEP), the centre of mass, angles and forces
(https://docs.vicon.com/display/Nexus, "Plug-in Gait output"). They follow from the markers: to fill
them by themselves would let them disagree.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

__all__ = ["model_outputs"]

_SEGMENT = re.compile(r"(.*\b(?:PEL|TRX|HED|[LR](?:CL|HU|RA|HN|FE|TI|FO|TO)))([OALP])((?:-\d+)?)")
"""A segment with its subject; its origin O, or axis A, L or P; the number of a repetition."""
_RESULT = re.compile(
    r"(.*:)?(CentreOfMass(Floor)?|[LR][A-Z][A-Za-z]+(Angles?|Force|Moment|Power|GRF)[A-Z]?)(-\d+)?"
)


def model_outputs(channels: Sequence[str]) -> tuple[str, ...]:
    """Return those channels that are results of Plug-in Gait.

    The axes of a segment count only beside its origin: alone, LTOP may be a marker.

    Examples
    --------
    >>> from mocapbench.benchmark.filling.requests.model_outputs import model_outputs
    >>> model_outputs(["LTOE.x", "LTOP.x", "Ann:LFEO.x", "Ann:LFEA.x", "CentreOfMass.z"])
    ('Ann:LFEO.x', 'Ann:LFEA.x', 'CentreOfMass.z')
    """
    points = {channel: channel.rpartition(".")[0] or channel for channel in channels}
    known = set(points.values())
    return tuple(channel for channel, point in points.items() if _is_output(point, known))


def _is_output(point: str, known: set[str]) -> bool:
    segment = _SEGMENT.fullmatch(point)
    if segment is None:
        return _RESULT.fullmatch(point) is not None
    return f"{segment[1]}O{segment[3]}" in known
