"""What the parameters of a C3D file say of its points: names, kinds, units and rate."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from itertools import islice, repeat
from math import isclose, isfinite

from mocapbench.datasets.formats.errors import FormatError, FormatWarning
from mocapbench.datasets.formats.markers.c3d_parameters import C3DParameters
from mocapbench.datasets.formats.model_outputs import POSITIONS, output_kinds

__all__ = [
    "frame_rate",
    "point_labels",
    "result_groups",
    "unit_of_group",
    "warn_of_scales",
]

_SINGULARS = {
    "ANGLES": "ANGLE",
    "FORCES": "FORCE",
    "MOMENTS": "MOMENT",
    "POWERS": "POWER",
    "SCALARS": "SCALAR",
    POSITIONS: "MODELED_MARKER",
}
"""Parameters that name results of a model of the body, and how those of their units begin."""
_ROUNDING = 1e-3  # relative


def point_labels(parameters: C3DParameters, n_points: int) -> list[str]:
    """Return the label of each point, which is empty if it has none."""
    labels = list(islice(parameters.texts("POINT:LABELS"), n_points))
    return labels + [""] * (n_points - len(labels))


def result_groups(parameters: C3DParameters, labels: Sequence[str]) -> list[str]:
    """Return the group of each point that is a result of a model of the body; "" for a marker.

    Parameters name results with the subject, as labels are ("Anna:LKneeAngles"), or without. Those
    of Plug-in Gait are known where no parameter names them.
    """
    groups: dict[str, str] = {}
    for group in _singulars(parameters):
        for label in filter(None, parameters.texts(f"POINT:{group}")):
            groups.setdefault(label, group)
    known = output_kinds(labels) | groups
    return [
        known.get(one) or groups.get(one.rpartition(":")[2], "") if one else "" for one in labels
    ]


def unit_of_group(parameters: C3DParameters, group: str) -> str:
    """Return the unit of the points of a group; no group is that of markers."""
    positions = next(parameters.texts("POINT:UNITS"), "")
    singular = _singulars(parameters).get(group, "")
    units = parameters.texts(f"POINT:{singular}_UNITS" if group else "POINT:UNITS")
    return next(units, positions if group in {"", POSITIONS} else "")


def _singulars(parameters: C3DParameters) -> Mapping[str, str]:
    """Return the groups that the format or the file knows: TYPE_GROUPS names each with a type."""
    named = list(parameters.texts("POINT:TYPE_GROUPS"))
    pairs = zip(named[::2], [*named[1::2], *repeat("", len(named) % 2)], strict=True)
    return _SINGULARS | {group: singular for group, singular in pairs if group}


def frame_rate(file: str, parameters: C3DParameters) -> float:
    """Return the frames per second, of POINT:RATE or else of the header.

    Raises
    ------
    FormatError
        If neither is above 0.
    """
    claims = [*parameters.numbers("POINT:RATE")[:1], parameters.header_number(11)]
    rates = [rate for rate in claims if isfinite(rate) and rate > 0]
    if not rates:
        advice = "name the rate in frames per second, such as --rate 100"
        raise FormatError(file, "a positive frame rate", f"{claims[0]:g}", advice)
    if not isclose(rates[0], rates[-1], rel_tol=_ROUNDING):
        warnings.warn(
            f"{file}: expected one frame rate, got {rates[0]:g} in POINT:RATE and {rates[-1]:g} in "
            f"the header; the first is taken: name the right one with --rate",
            FormatWarning,
            stacklevel=2,
        )
    return rates[0]


def warn_of_scales(file: str, parameters: C3DParameters) -> None:
    """Warn if a file of integers names two scales, of which the header's is taken."""
    scale = parameters.header_number(7)
    others = parameters.numbers("POINT:SCALE")[:1]
    both = (scale, *others)
    if min(both) > 0 and not all(isclose(scale, one, rel_tol=_ROUNDING) for one in both):
        warnings.warn(
            f"{file}: expected one scale of its integers, got {scale:g} in the header and "
            f"{others[0]:g} in POINT:SCALE; the first is taken: if positions are too large or "
            "small, only units are wrong, not what is filled",
            FormatWarning,
            stacklevel=2,
        )
