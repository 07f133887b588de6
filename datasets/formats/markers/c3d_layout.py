"""Where the coordinates of points stand in a C3D file, to change some and nothing else.

The format is described in the C3D File Format User Guide (https://www.c3d.org/docs/C3D_User_Guide.pdf):
blocks of 512 bytes; a header of 16-bit words; then, frame by frame, four numbers a point (x, y, z,
and cameras with residual) and the analogue samples, either as 32-bit floats or as 16-bit integers
that are to be multiplied by a scale.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mocapbench.datasets.formats.errors import FormatError

__all__ = ["BLOCK", "MOST_FRAMES", "C3DLayout", "read_layout"]

BLOCK = 512
"""Bytes."""
MOST_FRAMES = 65535
"""What the header can count."""

_MAGIC = 0x50
_INTEL, _DEC, _MIPS = 84, 85, 86
_ORDER = {_INTEL: "<", _MIPS: ">"}


@dataclass(frozen=True)
class C3DLayout:
    """The frames of a file.

    Parameters
    ----------
    start : int
        Byte of the first frame.
    n_frames : int
        How many the header counts.
    n_points : int
        Points of a frame.
    n_samples : int
        Analogue samples of a frame.
    dtype : dtype
        Of the numbers.
    scale : float
        Which integers are multiplied by; 1 for floats.
    """

    start: int
    n_frames: int
    n_points: int
    n_samples: int
    dtype: np.dtype[Any]
    scale: float

    @property
    def numbers(self) -> int:
        """Numbers of a frame."""
        return 4 * self.n_points + self.n_samples

    def end(self, n_frames: int) -> int:
        """Return the byte after ``n_frames`` frames."""
        return self.start + n_frames * self.numbers * self.dtype.itemsize

    def frames(self, path: Path, n_frames: int) -> np.memmap[Any, np.dtype[Any]]:
        """Return the numbers of all frames (N, numbers); changes of them change the file."""
        shape = (n_frames, self.numbers)
        return np.memmap(path, self.dtype, mode="r+", offset=self.start, shape=shape)


def read_layout(path: Path) -> C3DLayout:
    """Return the layout of a C3D file.

    Parameters
    ----------
    path : Path

    Raises
    ------
    FormatError
        If the header is not that of a C3D file, or the numbers are those of a DEC computer.
    """
    advice = "export the recording again as C3D"
    with path.open("rb") as stream:
        header = stream.read(BLOCK)
        if len(header) < BLOCK or header[1] != _MAGIC:
            got = f"{header[:8]!r}" if header else "an empty file"
            raise FormatError(path.name, "the header of a C3D file", got, advice)
        stream.seek(max(header[0] - 1, 0) * BLOCK)
        parameters = stream.read(4)
    processor = parameters[3] if len(parameters) == 4 else 0
    if processor not in _ORDER:
        got = "those of a DEC computer" if processor == _DEC else f"the type {processor}"
        raise FormatError(path.name, "numbers of Intel or MIPS computers", got, advice)
    return _layout(header, _ORDER[processor])


def _layout(header: bytes, order: str) -> C3DLayout:
    words = np.frombuffer(header, f"{order}u2")
    scale = float(np.frombuffer(header[12:16], f"{order}f4")[0])
    stored = np.dtype(f"{order}f4" if scale < 0 else f"{order}i2")
    start = max(int(words[8]) - 1, 0) * BLOCK
    n_frames = max(int(words[4]) - int(words[3]) + 1, 0)
    factor = 1.0 if scale < 0 else scale
    return C3DLayout(start, n_frames, int(words[1]), int(words[2]), stored, factor)
