"""C3D: the positions of markers, with residuals, as cameras measured them."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.formats.base import Extra, Format
from mocapbench.datasets.formats.building import even_times, recording_of
from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.isolation.calls import IsolatedCallError, call_isolated
from mocapbench.datasets.formats.markers.c3d_layout import (
    BLOCK,
    MOST_FRAMES,
    C3DLayout,
    read_layout,
)
from mocapbench.datasets.formats.markers.channels import marker_channels
from mocapbench.datasets.recording import FrameByChannel, Frames, Mask, Recording

__all__ = ["C3DFormat"]

_READER = "mocapbench.datasets.formats.markers.c3d_points:read_points"
_SECONDS, _SECONDS_PER_BYTE = 10.0, 1e-6  # 46 MB take 8 s
_MEMORY = 2**28  # of a small file


class C3DFormat(Format):
    """Positions of markers (.c3d) with residuals, read by ezc3d.

    The channels are ``LKNE.x``, ``LKNE.y``, ``LKNE.z`` and so on, in the unit that the file states.
    A point is hidden if its residual is negative, a coordinate is NaN, or it is exactly at the
    origin. Angles, forces and other results of a model of the body are not channels.

    Only the coordinates that are filled are changed, and the residuals of their points, which
    become 0: calculated, not measured. All other bytes stay: residuals, analogue samples, events.
    A file of integers gets its values rounded to multiples of its scale. A point of which no
    coordinate is known is filled as a whole or not at all.
    """

    suffixes = (".c3d",)
    needs = Extra("ezc3d", "c3d")
    memory_per_byte = 24.0

    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has."""
        points = _points(path)
        values = _positions(points)
        channels = marker_channels(points["labels"][points["is_marker"]].tolist())
        times = even_times(len(values), rate or _rate(path.name, points))
        units = [str(points["unit"])] * len(channels)
        return recording_of(path.name, times, values, channels, units)

    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write the file's bytes with the new coordinates."""
        points = _points(like)
        layout, visible = read_layout(like), _positions(points)
        # Where each coordinate stands in a frame: x, y and z of a point, then its residual.
        columns = (4 * np.flatnonzero(points["is_marker"])[:, None] + np.arange(3)).ravel()
        shutil.copyfile(like, path)
        frames = layout.frames(path, len(values))
        _check_places(like, frames[:, columns] * layout.scale, visible)
        new = new & _whole_points(new | ~np.isnan(visible))
        rows, channels = np.nonzero(new)
        frames[rows, columns[channels]] = _stored(like, layout, values[new])
        frames[rows, columns[channels - channels % 3] + 3] = 0  # residual: calculated
        frames.flush()


def _points(path: Path) -> Mapping[str, NDArray[Any]]:
    """Return what `read_points` reads, having seen that the file has all of its frames."""
    size, layout = path.stat().st_size, read_layout(path)
    _check_size(path, layout.end(layout.n_frames), size)
    memory = C3DFormat.memory_per_byte * size + _MEMORY
    timeout = _SECONDS + _SECONDS_PER_BYTE * size
    try:
        points = call_isolated(_READER, str(path.absolute()), timeout=timeout, memory=memory)
    except IsolatedCallError as error:
        advice = "export the recording again as C3D"
        raise FormatError(path.name, "a C3D file that ezc3d reads", str(error), advice) from error
    if not points["is_marker"].any():
        advice = "export the positions of the markers too"
        raise FormatError(path.name, "positions of markers", "other signals alone", advice)
    _, n_points, n_frames = points["points"].shape
    if n_points != layout.n_points:
        expected, got = f"{layout.n_points} points, as its header says", f"{n_points} in POINT:USED"
        raise FormatError(path.name, expected, got, "export the recording again as C3D")
    _check_size(path, layout.end(n_frames), size)
    if n_frames >= MOST_FRAMES and size >= layout.end(n_frames + 1) + BLOCK:
        advice = "cut the recording into parts, or export it in another format"
        got = "more, of which ezc3d reads no others"
        raise FormatError(path.name, f"at most {MOST_FRAMES} frames", got, advice)
    return points


def _check_size(path: Path, needed: int, size: int) -> None:
    if size < needed:
        advice = "the file is cut short: copy or export it again"
        raise FormatError(path.name, f"{needed} bytes, as its header says", f"{size}", advice)


def _positions(points: Mapping[str, NDArray[Any]]) -> FrameByChannel:
    """Return the coordinates of all markers, (N, 3 · markers), NaN where they are not valid."""
    positions = points["points"][:, points["is_marker"]]  # (3, markers, N)
    measured = points["residuals"][points["is_marker"]] >= 0
    valid = measured & np.isfinite(positions).all(axis=0) & (positions != 0).any(axis=0)
    values = np.where(valid, positions, np.nan)
    return values.transpose(2, 1, 0).reshape(values.shape[2], -1)


def _rate(file: str, points: Mapping[str, NDArray[Any]]) -> float:
    rate = float(points["rate"])
    if not (isfinite(rate) and rate > 0):
        advice = "name the rate in frames per second, such as --rate 100"
        raise FormatError(file, "a positive frame rate", f"{rate:g}", advice)
    return rate


def _check_places(like: Path, found: FrameByChannel, visible: FrameByChannel) -> None:
    """Refuse to write where coordinates do not stand as the header says."""
    seen = ~np.isnan(visible)
    if not np.allclose(found[seen], visible[seen], rtol=1e-5, atol=0.0):
        raise FormatError(
            like.name,
            "coordinates where the header says that they are",
            "others",
            "export the recording again as C3D",
        )


def _whole_points(known: Mask) -> Mask:
    """Return True for the coordinates of points of which all three are known."""
    whole = known.reshape(len(known), -1, 3).all(axis=2)
    return np.repeat(whole, 3, axis=1)


def _stored(like: Path, layout: C3DLayout, values: Frames) -> Frames:
    """Return coordinates as the file stores them."""
    stored = values / layout.scale
    if layout.dtype.kind != "i":
        return stored
    limits = np.iinfo(np.int16)
    if len(stored) and (stored.min() < limits.min or stored.max() > limits.max):
        raise FormatError(
            like.name,
            f"coordinates within ±{limits.max * layout.scale:g}, as the file stores integers",
            f"{values[np.abs(values).argmax()]:g}",
            "export the recording as C3D with floating-point numbers",
        )
    return np.round(stored)
