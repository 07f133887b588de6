"""Acclaim motions (.amc) beside their skeletons (.asf), as files of users' own."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from math import degrees
from pathlib import Path
from typing import ClassVar

import numpy as np

from mocapbench.datasets.acclaim.errors import AcclaimError
from mocapbench.datasets.acclaim.motion import Motion
from mocapbench.datasets.acclaim.motion_reader import read_motion
from mocapbench.datasets.acclaim.skeleton import Skeleton
from mocapbench.datasets.acclaim.skeleton_reader import read_skeleton
from mocapbench.datasets.formats.base import Format
from mocapbench.datasets.formats.building import even_times
from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.text.cells import Words
from mocapbench.datasets.formats.text.lines import read_lines, write_lines
from mocapbench.datasets.formats.text.numbers import format_number
from mocapbench.datasets.recording import FrameByChannel, Mask, Recording

__all__ = ["AcclaimFormat"]

_OF_HEADER = ("", "#", ":")
_ANGLE_UNITS = {":DEGREES": 1.0, ":RADIANS": degrees(1.0)}


class AcclaimFormat(Format):
    """Acclaim motions (.amc) with the skeleton (.asf) in the same folder.

    The skeleton is the file of the same name, else that of the subject (``35.asf`` for
    ``35_02.amc``), else the only one. The format states no frame rate, so that of the CMU database
    is taken, 120 frames a second, unless another is given. It has no way to state a gap either: the
    gaps are those that the user names. Angles are in degrees, also those of a file in radians,
    which is written in radians again.
    """

    suffixes: ClassVar[tuple[str, ...]] = (".amc",)
    memory_per_byte: ClassVar[float] = 20.0

    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has."""
        recording = self._motion(path).recording(path.name)
        if rate is None:
            return recording
        return replace(recording, times=even_times(len(recording.times), rate))

    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write the file's lines with the new numbers."""
        lines, moving = read_lines(like), self.skeleton(like).moving
        start = next(k for k, line in enumerate(lines) if line.strip()[:1] not in _OF_HEADER)
        unit = _ANGLE_UNITS[next(word for word in _words(lines[:start]) if word in _ANGLE_UNITS)]
        segments = list(_words(lines[start + 1 : start + 1 + len(moving)]))
        dofs = [dof for name in segments for dof in moving[name]]
        stated = values / [unit if dof.startswith("r") else 1.0 for dof in dofs]
        places = _places(segments, moving)
        for frame, channel in np.argwhere(new).tolist():
            segment, word = places[channel]
            line = start + frame * (1 + len(moving)) + 1 + segment
            number = format_number(stated[frame, channel])
            lines[line] = Words().replace_cells(lines[line], {word: number})
        write_lines(path, lines, like)

    def skeleton(self, path: Path) -> Skeleton:
        """Return the skeleton beside a motion.

        Raises
        ------
        FormatError
            If there is none, or it is malformed.
        """
        try:
            return read_skeleton(_skeleton_file(path))
        except AcclaimError as error:
            raise _plain(error, "export the skeleton again") from error

    def _motion(self, path: Path) -> Motion:
        try:
            return read_motion(path, self.skeleton(path))
        except AcclaimError as error:
            advice = (
                "export the motion again, whole and without NaN: a file may be cut short, and gaps "
                "are named, not written"
            )
            raise _plain(error, advice) from error


def _skeleton_file(path: Path) -> Path:
    """Return the skeleton of a motion in the same folder."""
    named = [path.with_suffix(".asf"), path.with_name(f"{path.stem.partition('_')[0]}.asf")]
    only = sorted(path.parent.glob("*.asf"))
    candidates = [*named, *(only if len(only) == 1 else [])]
    for candidate in candidates:
        if candidate.is_file():
            return candidate
    raise FormatError(
        str(path),
        f"its skeleton {' or '.join(dict.fromkeys(file.name for file in named))} beside it",
        f"{len(only)} other .asf files" if only else "no .asf file",
        "copy the skeleton of the same subject into the folder",
    )


def _plain(error: AcclaimError, advice: str) -> FormatError:
    return FormatError(error.file, error.expected, error.got, advice, error.line)


def _words(lines: Sequence[str]) -> Iterator[str]:
    return (word for line in lines for word in line.split()[:1])


def _places(segments: Sequence[str], moving: Mapping[str, Sequence[str]]) -> list[tuple[int, int]]:
    """Return the line and the word of each channel, given the segments in the order of a frame."""
    return [
        (segment, word)
        for segment, name in enumerate(segments)
        for word, _ in enumerate(moving[name], 1)  # after the segment's name
    ]
