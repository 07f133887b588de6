"""C3D: the positions of markers, with residuals, as cameras measured them."""

from __future__ import annotations

import shutil
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.formats.base import Format
from mocapbench.datasets.formats.building import even_times, recording_of
from mocapbench.datasets.formats.errors import FormatError, FormatWarning
from mocapbench.datasets.formats.markers.c3d_layout import C3DLayout, find_layout
from mocapbench.datasets.formats.markers.c3d_parameters import C3DParameters, read_parameters
from mocapbench.datasets.formats.markers.c3d_points import (
    frame_rate,
    point_labels,
    result_groups,
    unit_of_group,
    warn_of_scales,
)
from mocapbench.datasets.formats.markers.channels import marker_channels
from mocapbench.datasets.formats.model_outputs import POSITIONS
from mocapbench.datasets.recording import FrameByChannel, Frames, Mask, Recording

__all__ = ["C3DFormat"]


class C3DFormat(Format):
    """Positions of markers (.c3d) with residuals, in numbers of Intel, DEC or MIPS computers.

    The channels are ``LKNE.x``, ``LKNE.y``, ``LKNE.z`` and so on, in the unit that the file states.
    A point is hidden if its residual is negative, a coordinate is NaN, or it is exactly at the
    origin, where angles, forces and other results that are no positions may well be. `results`
    names the channels of results of a model of the body.

    Only the coordinates that are filled are changed, and the residuals of their points, which
    become 0: calculated, not measured. All other bytes stay: residuals, analogue samples, events.
    A file of integers gets its values rounded to multiples of its scale, and those beyond the
    largest as that, with a warning. A point of which no coordinate is known is filled as a whole or
    not at all.
    """

    suffixes: ClassVar[tuple[str, ...]] = (".c3d",)
    memory_per_byte: ClassVar[float] = 12.0

    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has."""
        parameters = read_parameters(path)
        layout = find_layout(path, parameters)
        if not layout.n_points:
            advice = "export the recording again, with its markers"
            raise FormatError(path.name, "positions of points", "analogue samples alone", advice)
        if layout.scale > 0:
            warn_of_scales(path.name, parameters)
        labels, groups = _name_points(layout, parameters)
        values = np.empty((layout.n_frames, 3 * layout.n_points))
        for frames, points in layout.blocks(path, "r"):
            values[frames] = _visible_points(layout, points, groups)
        times = even_times(layout.n_frames, rate or frame_rate(path.name, parameters))
        units = [unit for group in groups for unit in 3 * [unit_of_group(parameters, group)]]
        return recording_of(path.name, times, values, marker_channels(labels), units)

    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write the file's bytes with the new coordinates."""
        parameters = read_parameters(like)
        layout = find_layout(like, parameters)
        _, groups = _name_points(layout, parameters)
        new = new.copy()
        for frames, points in layout.blocks(like, "r"):
            visible = ~np.isnan(_visible_points(layout, points, groups))
            new[frames] &= _whole_points(new[frames] | visible)
        stored = _encode_coordinates(like, layout, values[new])
        shutil.copyfile(like, path)
        stops = np.cumsum(np.count_nonzero(new, axis=1))
        for frames, points in layout.blocks(path, "r+"):
            at, channels = np.nonzero(new[frames])
            stop = int(stops[frames][-1])
            points[at, channels // 3, channels % 3] = stored[stop - len(at) : stop]
            points[at, channels // 3, 3] = 0  # residual: calculated, in any format

    def results(self, path: Path, channels: Sequence[str]) -> tuple[str, ...]:
        """Return the channels of results, as the file's parameters or their names say."""
        parameters = read_parameters(path)
        _, groups = _name_points(find_layout(path, parameters), parameters)
        return tuple(name for place, name in enumerate(channels) if groups[place // 3])


def _name_points(layout: C3DLayout, parameters: C3DParameters) -> tuple[list[str], list[str]]:
    """Return the label of each point, and its group if it is a result of a model of the body."""
    labels = point_labels(parameters, layout.n_points)
    return labels, result_groups(parameters, labels)


def _visible_points(
    layout: C3DLayout, points: NDArray[Any], groups: Sequence[str]
) -> FrameByChannel:
    """Return the numbers of points (N, M, 4) as (N, 3 · M), NaN where they are not valid."""
    may_be_zero = np.array([group not in {"", POSITIONS} for group in groups], dtype=bool)
    numbers = layout.decode(points)
    x, y, z, residual = np.moveaxis(numbers, 2, 0)
    placed = (x != 0) | (y != 0) | (z != 0) | may_be_zero
    valid = placed & (residual >= 0) & np.isfinite(x) & np.isfinite(y) & np.isfinite(z)
    return np.where(valid[..., np.newaxis], numbers[..., :3], np.nan).reshape(len(points), -1)


def _whole_points(known: Mask) -> Mask:
    """Return True for the coordinates of points of which all three are known."""
    whole = known.reshape(len(known), -1, 3).all(axis=2)
    return np.repeat(whole, 3, axis=1)


def _encode_coordinates(like: Path, layout: C3DLayout, values: Frames) -> NDArray[Any]:
    """Return coordinates as the file stores them: those beyond its limits as the limits."""
    low, high = layout.limits
    held = values.clip(low, high)
    beyond = values[np.abs(values - held) > max(layout.scale, 0.0) / 2.0]  # they are rounded, too
    if len(beyond):
        most = beyond[np.abs(beyond).argmax()]
        warnings.warn(
            f"{like.name}: expected coordinates from {low:g} to {high:g}, which the file can "
            f"store, got {len(beyond)} beyond, up to {most:g}, which are "
            "written as the nearest of these; to keep them, export the recording as C3D with "
            "floating-point numbers, and fill that",
            FormatWarning,
            stacklevel=2,
        )
    return layout.encode(held)
