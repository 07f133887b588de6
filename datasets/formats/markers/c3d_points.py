"""Reading the points of a C3D file by ezc3d, in a process of its own."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import ezc3d
import numpy as np
from numpy.typing import NDArray

__all__ = ["read_points"]

_OUTPUTS = ("ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS")
"""Parameters that name the points which are not positions, but results of a model of the body."""
_POSITIONS = "MODELED_MARKERS"


def read_points(path: str) -> Mapping[str, NDArray[Any]]:
    """Return ``points`` (3, M, N), ``residuals`` (M, N), ``labels`` (M,), ``rate`` and ``unit``.

    ``is_marker`` (M,) is False for results of a model of the body, such as angles and forces.
    """
    file = ezc3d.c3d(path)
    points = file["data"]["points"]
    parameters = file["parameters"]["POINT"]
    labels = list(_texts(parameters, "LABELS"))[: points.shape[1]]
    labels += [""] * (points.shape[1] - len(labels))
    groups = {*_OUTPUTS, *list(_texts(parameters, "TYPE_GROUPS"))[::2]} - {_POSITIONS, ""}
    outputs = {name for group in groups for name in _texts(parameters, group)}
    return {
        "points": points[:3],
        "residuals": file["data"]["meta_points"]["residuals"][0],
        "labels": np.array(labels, dtype=np.str_),
        "is_marker": np.array([name not in outputs for name in labels], dtype=bool),
        "rate": np.array(float(file["header"]["points"]["frame_rate"])),
        "unit": np.array(next(_texts(parameters, "UNITS"), "")),
    }


def _texts(parameters: Mapping[str, Any], name: str) -> Iterator[str]:
    """Yield the texts of a parameter, and of those that continue it: LABELS, LABELS2, ..."""
    number = 1
    while (key := name if number == 1 else f"{name}{number}") in parameters:
        yield from map(str, parameters[key]["value"])
        number += 1
