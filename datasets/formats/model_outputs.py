"""Which points are results of a model of the body, not markers, by the names of Plug-in Gait.

It puts them beside the markers, and not all of its files say which they are. They follow from the
markers: to fill them by themselves would let them disagree. The names are those of Vicon's
documentation (https://docs.vicon.com, "Plug-in Gait output specification" and "Complete list of
Plug-in Gait bones"), a bone as its origin O and its axes A, L and P, and those of joint centres and
centres of mass, which Vicon's models in BodyLanguage and Python write.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import product

__all__ = ["POSITIONS", "model_outputs", "output_kinds"]

POSITIONS = "MODELED_MARKERS"
"""The kind of results that are positions."""
_SIDES = ("L", "R")
_LIMBS = ("Hip", "Knee", "Ankle", "Shoulder", "Elbow", "Wrist")
_TRUNK = ("Pelvis", "Spine", "Thorax", "Neck", "Head")
_LOADED = (*_LIMBS, "Waist", "Neck")
_CENTRES_OF = ("Hand", "Radius", "Humerus", "Femur", "Tibia", "Foot")


def _sided(*names: str) -> Iterator[str]:
    return (side + name for side, name in product(_SIDES, names))


_KINDS: Mapping[str, frozenset[str]] = {
    "ANGLES": frozenset(
        [
            *_sided(*(f"{part}Angles" for part in (*_LIMBS, *_TRUNK, "FootProgress"))),
            *_sided("AbsAnkleAngle", "AbsAnkleAngles"),
            *(f"{part}Angles" for part in _TRUNK),
        ]
    ),
    "FORCES": frozenset(
        _sided(*(f"{joint}Force" for joint in (*_LOADED, "GroundReaction")), "NormalisedGRF", "GRF")
    ),
    "MOMENTS": frozenset(_sided(*(f"{joint}Moment" for joint in (*_LOADED, "GroundReaction")))),
    "POWERS": frozenset(_sided(*(f"{joint}Power" for joint in _LOADED))),
    POSITIONS: frozenset(
        [
            *("CentreOfMass", "CentreOfMassFloor", "PelvisCOM", "ThoraxCOM", "HeadCOM"),
            *(f"{s}{part}COM" for s, part in product(("Left", "Right"), _CENTRES_OF)),
            *_sided(*(f"{joint}JC" for joint in "HKASEW")),
        ]
    ),
}
_BONES = frozenset(
    [
        *("PEL", "SAC", "CSP", "TRX", "HED"),
        *_sided("CL", "HU", "RA", "HN", "FE", "TI", "FO", "TO"),
    ]
)
_POINT = re.compile(r"(?P<subject>.*:)?(?P<name>[^:]*?)(?P<repeated>-\d+)?")


def output_kinds(points: Sequence[str]) -> dict[str, str]:
    """Return the points that are results of Plug-in Gait, each with the kind of its values.

    Points may have their subject before the name (``Ann:LFEO``) and the number of a repetition
    after it. The axes of a bone count only beside its origin: alone, LTOP may be a marker.

    Examples
    --------
    >>> from mocapbench.datasets.formats.model_outputs import output_kinds
    >>> output_kinds(["LTOE", "LTOP", "Ann:LFEO", "Ann:LFEA", "LKneeAngles"])
    {'Ann:LFEO': 'MODELED_MARKERS', 'Ann:LFEA': 'MODELED_MARKERS', 'LKneeAngles': 'ANGLES'}
    """
    known = set(points)
    kinds = ((point, _kind(point, known)) for point in dict.fromkeys(points))
    return {point: kind for point, kind in kinds if kind}


def model_outputs(channels: Sequence[str]) -> tuple[str, ...]:
    """Return the channels of points that are results of Plug-in Gait, as `output_kinds`.

    Examples
    --------
    >>> from mocapbench.datasets.formats.model_outputs import model_outputs
    >>> model_outputs(["LTOE.x", "CentreOfMass.z", "LKneeAngles.y"])
    ('CentreOfMass.z', 'LKneeAngles.y')
    """
    points = {channel: channel.rpartition(".")[0] or channel for channel in channels}
    results = output_kinds([*points.values()])
    return tuple(channel for channel, point in points.items() if point in results)


def _kind(point: str, known: set[str]) -> str:
    """Return the kind of a result among known points; an empty text for what is none."""
    found = _POINT.fullmatch(point)
    if found is None:
        return ""
    subject, name, repeated = (found[part] or "" for part in ("subject", "name", "repeated"))
    if name[:-1] in _BONES and name[-1] in "OALP":
        return POSITIONS if f"{subject}{name[:-1]}O{repeated}" in known else ""
    return next((kind for kind, names in _KINDS.items() if name in names), "")
