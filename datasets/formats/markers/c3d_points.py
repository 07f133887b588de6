"""What the parameters of a C3D file say of its points: names, unit, rate, and which are markers."""

from __future__ import annotations

import warnings
from itertools import islice
from math import isclose, isfinite

import numpy as np

from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.markers.c3d_parameters import C3DParameters

__all__ = ["frame_rate", "marker_places", "point_labels", "warn_of_scales"]

_OUTPUTS = ("ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS")
"""Parameters that name the points which are not positions, but results of a model of the body."""
_POSITIONS = "MODELED_MARKERS"
_ROUNDING = 1e-3  # relative


def point_labels(parameters: C3DParameters, n_points: int) -> list[str]:
    """Return the label of each point, which is empty if it has none."""
    labels = list(islice(parameters.texts("POINT:LABELS"), n_points))
    return labels + [""] * (n_points - len(labels))


def marker_places(
    parameters: C3DParameters, labels: list[str]
) -> np.ndarray[tuple[int], np.dtype[np.intp]]:
    """Return which points are positions, not results of a model of the body.

    Results may be named with the subject, as labels are ("Anna:LKneeAngles"), or without.
    """
    groups = {*_OUTPUTS, *islice(parameters.texts("POINT:TYPE_GROUPS"), 0, None, 2)}
    named = (parameters.texts(f"POINT:{group}") for group in groups - {_POSITIONS, ""})
    results = {label for texts in named for label in texts} - {""}
    places = [
        place
        for place, label in enumerate(labels)
        if label not in results and label.rpartition(":")[2] not in results
    ]
    return np.array(places, dtype=np.intp)


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
            stacklevel=2,
        )
