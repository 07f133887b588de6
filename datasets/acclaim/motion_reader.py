"""Reading Acclaim motion files (.amc), strictly.

The first frame gives the order of the segments, which every other frame must repeat. One defect of
real captures only gives a warning: a last frame without its last segments is dropped.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from io import StringIO
from itertools import chain, takewhile
from math import degrees
from pathlib import Path

import numpy as np

from mocapbench.datasets.acclaim.errors import AcclaimError, TruncatedFrameWarning
from mocapbench.datasets.acclaim.frames import Frame, Layout, frames
from mocapbench.datasets.acclaim.motion import Motion
from mocapbench.datasets.acclaim.skeleton import Skeleton
from mocapbench.datasets.acclaim.text import name_list, read_text

__all__ = ["parse_motion", "read_motion"]

_FULLY_SPECIFIED = ":FULLY-SPECIFIED"
_DEGREES_PER = {":DEGREES": 1.0, ":RADIANS": degrees(1.0)}
_N_KEYWORDS = 2
_MAX_DIGITS = 9  # of a frame number: 96 days
_MAX_BYTES = 2**28  # about 45 minutes of all channels


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
        If the file is missing, malformed, of another skeleton or larger than 256 MiB.

    Warns
    -----
    TruncatedFrameWarning
        If the last frame is incomplete and was dropped.

    Notes
    -----
    Reading takes at most 0.13 MB of memory, 16 bytes for each byte of the file, whatever it
    contains, and 80 for each of the skeleton's; files of the CMU database take 7 for each byte.

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
    try:
        return parse_motion(read_text(path, _MAX_BYTES), skeleton, str(path))
    except AcclaimError as problem:
        # The frames of the parser would keep the whole file in memory as long as the error.
        raise problem.with_traceback(None) from problem.__cause__


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
    text = text.rstrip()
    start, degrees_per_unit = _header(text, file)
    moving = skeleton.moving
    split = partial(frames, text, file, start, 1 + len(moving))
    opening = next(split(), Frame(file, start, ()))
    first = _first(opening)
    segments = _segments(opening, moving)
    layout = Layout([(name, len(moving[name])) for name in segments])
    rows = _rows(split(), first, layout)
    dof = [name for segment in segments for name in moving[segment]]
    # Numbers go into the array at once: in lists, they would take four times the memory.
    values = np.fromiter(chain.from_iterable(rows), dtype=np.float64).reshape(-1, len(dof))
    values *= [degrees_per_unit if name[0] == "r" else 1.0 for name in dof]
    return Motion(skeleton, segments, values)


def _header(text: str, file: str) -> tuple[int, float]:
    """Return the index of the first frame and the unit of its angles."""
    keywords: list[str] = []
    index = 0
    for line in takewhile(_is_header, StringIO(text)):
        keywords += [word for word in line.split(maxsplit=1)[:1] if word.startswith(":")]
        index += 1
        if len(keywords) > _N_KEYWORDS:
            break
    units = [word for word in keywords if word in _DEGREES_PER]
    if len(units) != 1 or sorted(keywords) != sorted((*units, _FULLY_SPECIFIED)):
        expected = f"a header of {_FULLY_SPECIFIED!r} and one of {', '.join(_DEGREES_PER)}"
        raise AcclaimError(file, index + 1, expected, name_list(keywords) or "none")
    return index, _DEGREES_PER[units[0]]


def _is_header(line: str) -> bool:
    return line.lstrip()[:1] in ("", "#", ":")


def _first(opening: Frame) -> int:
    """Return the number of the first frame."""
    line = opening.line(0)
    number = line.words[0] if len(line.words) == 1 else ""
    if not (number.isascii() and number.isdigit() and len(number) <= _MAX_DIGITS):
        raise line.error(f"the number of the first frame, of at most {_MAX_DIGITS} digits")
    return int(number)


def _segments(opening: Frame, moving: Mapping[str, Sequence[str]]) -> tuple[str, ...]:
    """Return the order of the segments, from the first frame."""
    remaining = dict(moving)
    segments = []
    for index in range(1, 1 + len(moving)):
        line = opening.line(index)
        name = line.words[0] if line.words else ""
        if name not in remaining:
            missing = name_list(remaining)
            raise line.error(f"one of the segments of the skeleton that remain: {missing}")
        del remaining[name]
        segments.append(name)
    return tuple(segments)


def _rows(split: Iterable[Frame], first: int, layout: Layout) -> Iterator[list[float]]:
    """Yield the values of each whole frame."""
    for number, frame in enumerate(split, first):
        row = frame.values(number, layout)
        n_segments = len(layout.counts)
        lacking = 1 + n_segments - len(frame.texts)
        if lacking:
            warnings.warn(
                f"{frame.file}: the last frame lacks {lacking} of its {n_segments} segments "
                "and was dropped",
                TruncatedFrameWarning,
                stacklevel=4,
            )
            return
        yield row
