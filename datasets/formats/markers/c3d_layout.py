"""Where the coordinates of points stand in a C3D file, to read all and change some.

Frame by frame stand four numbers a point (x, y, z, and cameras with residual) and the analogue
samples, as 32-bit floating-point numbers or as 16-bit integers that are to be multiplied by a
scale. Header and parameters both say how many of them there are, and in files of many programs
they disagree. What the file has room for decides then: a frame taken too long or too short would
shift all coordinates of the frames that follow it.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import product
from math import isfinite
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.formats.errors import FormatError, FormatWarning
from mocapbench.datasets.formats.markers.c3d_numbers import Processor
from mocapbench.datasets.formats.markers.c3d_parameters import BLOCK, WORD, C3DParameters
from mocapbench.datasets.recording import Frames

__all__ = ["C3DLayout", "find_layout"]

_MOST = 0xFFFF
"""Frames that the header can count."""
_HEADER = "its header"
_AGAIN = "export the recording again as C3D"
_CUT = "the file is cut short: copy or export it again"
_PIECE = 2**16  # bytes read at once
_BLOCK = 1024  # frames

_Claims = dict[float, str]
"""Each number that is claimed, and where."""


@dataclass(frozen=True)
class C3DLayout:
    """The frames of a file.

    Parameters
    ----------
    processor : Processor
    start : int
        Byte of the first frame.
    n_frames : int
    n_points : int
        Points of a frame.
    n_samples : int
        Analogue samples of a frame, of all channels.
    scale : float
        Which integers are multiplied by; below 0, numbers are floating-point and are not.
    """

    processor: Processor
    start: int
    n_frames: int
    n_points: int
    n_samples: int
    scale: float

    @property
    def dtype(self) -> np.dtype[Any]:
        """Of the numbers as stored."""
        integer = np.dtype(f"{self.processor.order}i2")
        return self.processor.stored if self.scale < 0 else integer

    @property
    def end(self) -> int:
        """The byte after the last frame."""
        size = (4 * self.n_points + self.n_samples) * self.dtype.itemsize
        return self.start + self.n_frames * size

    @property
    def shape(self) -> tuple[int, int, int, bool]:
        """What decides where a coordinate stands."""
        return self.start, self.n_points, self.n_samples, self.scale < 0

    @property
    def limits(self) -> tuple[float, float]:
        """The smallest and the largest coordinate that can be stored."""
        words, largest = np.iinfo(np.int16), self.processor.largest
        whole = (float(words.min) * self.scale, float(words.max) * self.scale)
        return (-largest, largest) if self.scale < 0 else whole

    def points(self, path: Path, mode: Literal["r", "r+"]) -> NDArray[Any]:
        """Return the numbers of the points of all frames (N, points, 4), as stored in the file.

        Changes of them change the file if the mode is ``"r+"``.
        """
        shape = (self.n_frames, 4 * self.n_points + self.n_samples)
        frames = np.memmap(path, self.dtype, mode=mode, offset=self.start, shape=shape)
        return frames[:, : 4 * self.n_points].reshape(self.n_frames, self.n_points, 4)

    def blocks(self, path: Path, mode: Literal["r", "r+"]) -> Iterator[tuple[slice, NDArray[Any]]]:
        """Yield some frames after others, with the numbers of their points, as `points` does.

        Each part of the file is in memory as long as it is looked at, however long the file is.
        """
        size = (4 * self.n_points + self.n_samples) * self.dtype.itemsize
        for start in range(0, self.n_frames, _BLOCK):
            n_frames = min(_BLOCK, self.n_frames - start)
            part = replace(self, start=self.start + start * size, n_frames=n_frames)
            yield slice(start, start + n_frames), part.points(path, mode)

    def decode(self, stored: NDArray[Any]) -> NDArray[np.float64]:
        """Return coordinates from what is stored of them."""
        if self.scale < 0:
            return self.processor.decode(stored)
        return stored * self.scale

    def encode(self, values: Frames) -> NDArray[Any]:
        """Return what is stored for coordinates within the limits."""
        if self.scale < 0:
            return self.processor.encode(values)
        return np.round(values / self.scale).astype(np.int16)


def find_layout(path: Path, parameters: C3DParameters) -> C3DLayout:
    """Return the layout of a file.

    Of what header and parameters claim, those readings are considered that leave less than a block
    of the file, or zeros. If they agree on what a frame has, it is the one of the fewest frames
    that leaves nothing but zeros.

    Raises
    ------
    FormatError
        If the file is shorter than it says, or header and parameters disagree and its size does not
        decide between them.
    """
    claims, size = _claims(parameters), path.stat().st_size
    layouts = [_layout(parameters.processor, claimed) for claimed in product(*claims.values())]
    if not layouts:
        raise FormatError(path.name, "a scale of coordinates in its header", "none", _AGAIN)
    start = min(layout.start for layout in layouts)
    stop = _stop(parameters, start, size)
    whole = [layout for layout in layouts if layout.end <= stop]
    if not whole:
        needed = min(layout.end for layout in layouts)
        raise FormatError(path.name, f"{needed} bytes, as its header says", f"{size}", _CUT)
    used = _last_byte(path, start, stop)
    kept = [layout for layout in whole if used <= layout.end or stop < layout.end + BLOCK]
    covering = [layout for layout in kept if used <= layout.end]
    if _n_shapes(kept) != 1 or (_n_shapes(layouts) > 1 and not covering):
        return _take_only_layout(path.name, claims, layouts, size)
    return min(covering, key=lambda layout: layout.n_frames, default=kept[0])


def _n_shapes(layouts: Iterable[C3DLayout]) -> int:
    return len({layout.shape for layout in layouts})


def _stop(parameters: C3DParameters, start: int, size: int) -> int:
    """Return the byte at which what follows the frames begins: parameters, rotations or nothing."""
    rotations = [
        (int(n) - 1) * BLOCK for _, n in _number_by_name(parameters, "ROTATION:DATA_START")
    ]
    return min(
        stop for stop in (size, parameters.start, *rotations) if stop > start or stop == size
    )


def _take_only_layout(
    file: str, claims: dict[str, _Claims], layouts: list[C3DLayout], size: int
) -> C3DLayout:
    """Return the only layout that is claimed, with a warning that the file does not end with it.

    Raises
    ------
    FormatError
        If there are more, or more frames than can be counted.
    """
    disputed = [
        f"{what}: " + ", ".join(f"{number:g} in {where}" for number, where in found.items())
        for what, found in claims.items()
        if len(found) > 1
    ]
    if disputed:
        expected = f"header and parameters that agree, or of which one fits the file's {size} bytes"
        raise FormatError(file, expected, "; ".join(disputed), _AGAIN)
    if layouts[0].n_frames == _MOST:
        raise _too_many_frames(file)
    warnings.warn(
        f"{file}: expected no more than {layouts[0].end} bytes, as its header says, got {size}; "
        "what follows is left alone: if positions jump from frame to frame, export the file again",
        FormatWarning,
        stacklevel=2,
    )
    return layouts[0]


def _last_byte(path: Path, start: int, stop: int) -> int:
    """Return the byte after the last one between ``start`` and ``stop`` that is not 0."""
    with path.open("rb") as stream:
        for stop_of_piece in range(stop, start, -_PIECE):
            first = max(stop_of_piece - _PIECE, start)
            stream.seek(first)
            used = len(stream.read(stop_of_piece - first).rstrip(b"\0"))
            if used:
                return first + used
    return start


def _claims(parameters: C3DParameters) -> dict[str, _Claims]:
    """Return what header and parameters say of each part of a layout, the preferred one first."""
    return {
        "data from block": _starts(parameters),
        "frames": _frame_counts(parameters),
        "points": _point_counts(parameters),
        "analogue numbers a frame": _sample_counts(parameters),
        "scale": _scales(parameters),
    }


def _layout(processor: Processor, claimed: tuple[float, ...]) -> C3DLayout:
    block, n_frames, n_points, n_samples = map(int, claimed[:-1])
    return C3DLayout(processor, (block - 1) * BLOCK, n_frames, n_points, n_samples, claimed[-1])


def _starts(parameters: C3DParameters) -> _Claims:
    """Return the blocks at which data may begin; behind the parameters if none is named."""
    named = [(_HEADER, parameters.header_word(9)), *_number_by_name(parameters, "POINT:DATA_START")]
    claims = _first_of_each((block, where) for where, block in named if block >= 2)
    return claims or {parameters.stop // BLOCK + 1: "the length of its parameters"}


def _frame_counts(parameters: C3DParameters) -> _Claims:
    """Return how many frames there may be.

    The header counts in 16 bits, in which numbers of frames beyond 65,535 are lost or wrap around.
    Parameters have more: a floating-point number, or two words, the low one first.
    """
    first, last = parameters.header_word(4), parameters.header_word(5)
    named = [
        *_number_by_name(parameters, "POINT:LONG_FRAMES"),
        *_field_span(parameters),
        (_HEADER, (last - first) % (_MOST + 1) + 1),
        *_number_by_name(parameters, "POINT:FRAMES"),
    ]
    return _first_of_each((frames, where) for where, frames in named if frames >= 1)


def _field_span(parameters: C3DParameters) -> list[tuple[str, float]]:
    """Return the number of frames from the first to the last field of a trial."""
    first, last = (
        [number for _, number in _number_by_name(parameters, f"TRIAL:ACTUAL_{end}_FIELD")]
        for end in ("START", "END")
    )
    spans = [last[0] - first[0] + 1] if first and last else []
    return [("TRIAL:ACTUAL_START_FIELD and ACTUAL_END_FIELD", span) for span in spans]


def _point_counts(parameters: C3DParameters) -> _Claims:
    named = [(_HEADER, parameters.header_word(2)), *_number_by_name(parameters, "POINT:USED")]
    return _first_of_each((points, where) for where, points in named)


def _sample_counts(parameters: C3DParameters) -> _Claims:
    """Return how many analogue numbers a frame may have: channels times samples of each."""
    total, each = (float(parameters.header_word(number)) for number in (3, 10))
    products = [
        (channels * each, f"{name} and {_HEADER}")
        for name, channels in _number_by_name(parameters, "ANALOG:USED")
    ]
    return _first_of_each([(total, _HEADER), *products, *_rated_counts(parameters).items()])


def _rated_counts(parameters: C3DParameters) -> _Claims:
    """Return how many analogue numbers a frame has by the rates of the parameters."""
    names = ("ANALOG:USED", "ANALOG:RATE", "POINT:RATE")
    stated = [number for name in names for _, number in _number_by_name(parameters, name)]
    if len(stated) < len(names) or stated[2] <= 0:
        return {}
    channels, analogue, points = stated
    return {channels * round(analogue / points): " and ".join(names)}


def _scales(parameters: C3DParameters) -> _Claims:
    """Return what integers may be multiplied by; of two such scales, that of the header.

    In floating-point files the size of the scale says nothing about coordinates.
    """
    named = [(_HEADER, parameters.header_number(7)), *_number_by_name(parameters, "POINT:SCALE")]
    scales = [(scale, where) for where, scale in named if scale]
    floats = [(-1.0, where) for scale, where in scales if scale < 0]
    integers = [(scale, where) for scale, where in scales if scale > 0]
    return _first_of_each((*floats[:1], *integers[:1]))


def _number_by_name(parameters: C3DParameters, name: str) -> list[tuple[str, float]]:
    """Return the number of a parameter under its name, or nothing if it has none.

    Two words are one number, the low word first.
    """
    numbers = parameters.numbers(name)[:2]
    if numbers and parameters.values[name][0] == WORD:
        numbers = [sum(word * (_MOST + 1) ** place for place, word in enumerate(numbers))]
    return [(name, number) for number in numbers[:1] if isfinite(number)]


def _first_of_each(claims: Iterable[tuple[float, str]]) -> _Claims:
    """Return where each number is claimed first."""
    found: _Claims = {}
    for number, where in claims:
        found.setdefault(number, where)
    return found


def _too_many_frames(file: str) -> FormatError:
    expected = (
        "the number of frames in POINT:LONG_FRAMES or TRIAL:ACTUAL_END_FIELD, as there are more "
        f"than the {_MOST} that the header can count"
    )
    advice = "cut the recording into parts, or export it in another format"
    return FormatError(file, expected, "neither", advice)
