"""Reading Acclaim motion files (.amc), strictly.

The first frame gives the order of the segments, which every other frame must repeat. One defect of
real captures only gives a warning: a last frame without its last segments is dropped.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees
from pathlib import Path

import numpy as np

from mocapbench.datasets.acclaim.errors import AcclaimError, TruncatedFrameWarning
from mocapbench.datasets.acclaim.motion import Motion
from mocapbench.datasets.acclaim.skeleton import Skeleton
from mocapbench.datasets.acclaim.text import Line, finite_floats, read_text

__all__ = ["parse_motion", "read_motion"]

_FULLY_SPECIFIED = ":FULLY-SPECIFIED"
_DEGREES_PER = {":DEGREES": 1.0, ":RADIANS": degrees(1.0)}

_Layout = Sequence[tuple[str, int]]


def read_motion(path: str | Path, skeleton: Skeleton) -> Motion:
    """Read an .amc file.

    Parameters
    ----------
    path : path
        The file.
    skeleton : Skeleton
        Skeleton of the subject, from `read_skeleton`.

    Returns
    -------
    Motion
        N frames of all degrees of freedom, angles in degrees; ``motion.recording(name)`` makes a
        `Recording` of it.

    Raises
    ------
    AcclaimError
        If the file is missing, malformed or of another skeleton.

    Warns
    -----
    TruncatedFrameWarning
        If the last frame is incomplete and was dropped.

    Examples
    --------
    Write a synthetic recording to files and read it back:

    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from mocapbench.datasets import GaitLibrary, format_motion, format_skeleton
    >>> from mocapbench.datasets import read_motion, read_skeleton
    >>> motion = GaitLibrary().motion("01_01")
    >>> with TemporaryDirectory() as folder:
    ...     asf, amc = Path(folder, "01.asf"), Path(folder, "01_01.amc")
    ...     _ = asf.write_text(format_skeleton(motion.skeleton))
    ...     _ = amc.write_text(format_motion(motion))
    ...     again = read_motion(amc, read_skeleton(asf))
    >>> again.channels[-1], again.values.shape
    ('ltoes.rx', (331, 62))
    """
    return parse_motion(read_text(path), skeleton, str(path))


def parse_motion(text: str, skeleton: Skeleton, file: str) -> Motion:
    """Parse the text of an .amc file.

    Parameters
    ----------
    text : str
        Content of the file.
    skeleton : Skeleton
        Skeleton of the subject.
    file : str
        Name of the file in error messages.

    Raises
    ------
    AcclaimError
        If the text is malformed or of another skeleton.

    Warns
    -----
    TruncatedFrameWarning
        If the last frame is incomplete and was dropped.
    """
    source = _Source(file, text.rstrip().split("\n"))
    start, degrees_per_unit = _header(source)
    first = _first(source, start)
    segments = _segments(source, start, skeleton)
    dof = [skeleton.moving[name] for name in segments]
    rows = _rows(source, start, first, list(zip(segments, map(len, dof), strict=True)))
    scale = [degrees_per_unit if name[0] == "r" else 1.0 for names in dof for name in names]
    return Motion(skeleton, segments, np.array(rows) * scale)


@dataclass(frozen=True)
class _Source:
    """The lines of a file."""

    file: str
    lines: Sequence[str]

    def line(self, index: int) -> Line:
        """Return the line at a 0-based index, an empty one after the last."""
        text = self.lines[index] if index < len(self.lines) else ""
        return Line(self.file, index + 1, text.rstrip())


def _header(source: _Source) -> tuple[int, float]:
    """Return the index of the first frame and the unit of its angles."""
    keywords = []
    index = 0
    while index < len(source.lines) and source.lines[index].lstrip()[:1] in ("", "#", ":"):
        keywords += [word for word in source.line(index).words[:1] if word.startswith(":")]
        index += 1
    units = [word for word in keywords if word in _DEGREES_PER]
    if len(units) != 1 or sorted(keywords) != sorted((*units, _FULLY_SPECIFIED)):
        expected = f"a header of {_FULLY_SPECIFIED!r} and one of {', '.join(_DEGREES_PER)}"
        raise AcclaimError(source.file, index + 1, expected, " ".join(keywords) or "none")
    return index, _DEGREES_PER[units[0]]


def _segments(source: _Source, start: int, skeleton: Skeleton) -> tuple[str, ...]:
    """Return the order of the segments, from the first frame."""
    moving = skeleton.moving
    segments: list[str] = []
    index = start + 1
    while len(segments) < len(moving):
        line = source.line(index)
        name = line.words[0] if line.words else ""
        if name not in moving or name in segments:
            missing = ", ".join(name for name in moving if name not in segments)
            raise line.error(f"one of the segments of the skeleton that remain: {missing}")
        segments.append(name)
        index += 1
    return tuple(segments)


def _rows(source: _Source, start: int, first: int, layout: _Layout) -> list[list[float]]:
    """Return the values of each whole frame."""
    size = 1 + len(layout)
    rows = [
        _row(source, index, number, layout)
        for number, index in enumerate(range(start, len(source.lines), size), first)
    ]
    lacking = -(len(source.lines) - start) % size
    if lacking:
        warnings.warn(
            f"{source.file}: the last frame lacks {lacking} of its {len(layout)} segments "
            "and was dropped",
            TruncatedFrameWarning,
            stacklevel=4,
        )
        rows.pop()
    return rows


def _first(source: _Source, start: int) -> int:
    line = source.line(start)
    number = line.words[0] if len(line.words) == 1 else ""
    if not (number.isascii() and number.isdigit()):
        raise line.error("the number of the first frame")
    return int(number)


def _row(source: _Source, start: int, number: int, layout: _Layout) -> list[float]:
    """Return the values of the frame at line index ``start``; the last frame may be incomplete."""
    if source.lines[start].split() != [str(number)]:
        raise source.line(start).error(f"the frame number {number}")
    shape = layout[: len(source.lines) - start - 1]  # fewer in an incomplete last frame
    block = [text.split() for text in source.lines[start + 1 : start + 1 + len(shape)]]
    try:
        # All numbers of a frame at once: twice as fast as line by line.
        if all(map(_has_shape, block, shape)):
            return finite_floats([word for words in block for word in words[1:]])
    except ValueError:
        pass
    wrong = next(k for k, words in enumerate(block) if not _is_segment(words, shape[k]))
    name, count = shape[wrong]
    raise source.line(start + 1 + wrong).error(f"segment {name!r} with {count} finite numbers")


def _has_shape(words: Sequence[str], segment: tuple[str, int]) -> bool:
    return words[:1] == [segment[0]] and len(words) == 1 + segment[1]


def _is_segment(words: Sequence[str], segment: tuple[str, int]) -> bool:
    try:
        finite_floats(words[1:])
    except ValueError:
        return False
    return _has_shape(words, segment)
