"""C3D: the positions of markers, with residuals, as cameras measured them."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.formats.base import Format
from mocapbench.datasets.formats.building import even_times, recording_of
from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.markers.c3d_layout import C3DLayout, find_layout
from mocapbench.datasets.formats.markers.c3d_parameters import read_parameters
from mocapbench.datasets.formats.markers.c3d_points import (
    frame_rate,
    marker_places,
    point_labels,
    warn_of_scales,
)
from mocapbench.datasets.formats.markers.channels import marker_channels
from mocapbench.datasets.recording import FrameByChannel, Frames, Mask, Recording

__all__ = ["C3DFormat"]


class C3DFormat(Format):
    """Positions of markers (.c3d) with residuals, in numbers of Intel, DEC or MIPS computers.

    The channels are ``LKNE.x``, ``LKNE.y``, ``LKNE.z`` and so on, in the unit that the file states.
    A point is hidden if its residual is negative, a coordinate is NaN, or it is exactly at the
    origin. Angles, forces and other results of a model of the body, as parameters name them, are
    not channels.

    Only the coordinates that are filled are changed, and the residuals of their points, which
    become 0: calculated, not measured. All other bytes stay: residuals, analogue samples, events.
    A file of integers gets its values rounded to multiples of its scale. A point of which no
    coordinate is known is filled as a whole or not at all.
    """

    suffixes = (".c3d",)
    memory_per_byte = 12.0

    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has."""
        parameters = read_parameters(path)
        layout = find_layout(path, parameters)
        labels = point_labels(parameters, layout.n_points)
        places = marker_places(parameters, labels)
        if not len(places):
            advice = "export the positions of the markers too"
            raise FormatError(path.name, "positions of markers", "other signals alone", advice)
        if layout.scale > 0:
            warn_of_scales(path.name, parameters)
        values = _visible_positions(layout, layout.points(path, "r")[:, places])
        channels = marker_channels(labels[place] for place in places)
        times = even_times(layout.n_frames, rate or frame_rate(path.name, parameters))
        unit = next(parameters.texts("POINT:UNITS"), "")
        return recording_of(path.name, times, values, channels, [unit] * len(channels))

    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write the file's bytes with the new coordinates."""
        parameters = read_parameters(like)
        layout = find_layout(like, parameters)
        places = marker_places(parameters, point_labels(parameters, layout.n_points))
        given = layout.points(like, "r")[:, places]
        new = new & _whole_points(new | ~np.isnan(_visible_positions(layout, given)))
        stored = _encode_coordinates(like, layout, values[new])
        shutil.copyfile(like, path)
        points = layout.points(path, "r+")
        frames, channels = np.nonzero(new)
        points[frames, places[channels // 3], channels % 3] = stored
        points[frames, places[channels // 3], 3] = 0  # residual: calculated, in any format


def _visible_positions(layout: C3DLayout, points: NDArray[Any]) -> FrameByChannel:
    """Return the coordinates of points (N, M, 4) as (N, 3 · M), NaN where they are not valid."""
    positions = layout.decode(points[..., :3])
    measured = layout.decode(points[..., 3]) >= 0
    valid = measured & np.isfinite(positions).all(axis=2) & (positions != 0).any(axis=2)
    positions[~valid] = np.nan
    return positions.reshape(len(points), -1)


def _whole_points(known: Mask) -> Mask:
    """Return True for the coordinates of points of which all three are known."""
    whole = known.reshape(len(known), -1, 3).all(axis=2)
    return np.repeat(whole, 3, axis=1)


def _encode_coordinates(like: Path, layout: C3DLayout, values: Frames) -> NDArray[Any]:
    """Return coordinates as the file stores them."""
    if len(values) and np.abs(values).max() > layout.largest:
        raise FormatError(
            like.name,
            f"coordinates within ±{layout.largest:g}, as the file stores them",
            f"{values[np.abs(values).argmax()]:g}",
            "export the recording as C3D with floating-point numbers",
        )
    return layout.encode(values)
