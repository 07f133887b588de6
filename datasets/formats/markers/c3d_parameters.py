"""The header and the parameters of a C3D file.

The format is described in the C3D File Format User Guide
(https://www.c3d.org/docs/C3D_User_Guide.pdf): blocks of 512 bytes, the first of which is the
header, of 16-bit words. Parameters are records: the length of a name, the number of a group, which
is negative where the record names that group, the name, and the distance to the next record; then
the type of the values, their dimensions, and the values.
"""

# Why not by a library: of 73 files of some 15 programs, ezc3d 1.7 refuses 11 (MIPS, PhoeniX,
# OptiTrack, BKIN) and reads others by parameters that are wrong, so that coordinates are shifted
# from the second frame on; c3d 0.6 refuses 11, as it insists that header and parameters agree and
# that no name repeats. Neither tells where a number stands, which writing needs in order to leave
# all else as it is. The tests compare with both.

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import count, takewhile
from math import prod
from pathlib import Path

import numpy as np

from mocapbench.datasets.encoding import decode_text
from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.formats.markers.c3d_numbers import PROCESSORS, Processor

__all__ = ["BLOCK", "WORD", "C3DParameters", "Values", "read_parameters"]

BLOCK = 512
"""Bytes."""
_MAGIC = 0x50
_MOST_BLOCKS = 255  # of parameters, as a byte counts them
TEXT, BYTE, WORD, FLOAT = -1, 1, 2, 4
"""Kinds of values: characters, or numbers of so many bytes."""

Values = tuple[int, tuple[int, ...], memoryview]
"""The values of a parameter: of what kind they are, their dimensions, and what is stored."""
_NOTHING: Values = (BYTE, (), memoryview(b""))


@dataclass(frozen=True)
class C3DParameters:
    """What a file says about itself, in its header and in its parameters.

    Parameters
    ----------
    header : bytes
    processor : Processor
        By which numbers are stored.
    start, stop : int
        Bytes of the file between which the parameters stand.
    values : mapping of str to Values
        By names such as ``"POINT:LABELS"``.
    """

    header: bytes
    processor: Processor
    start: int
    stop: int
    values: Mapping[str, Values]

    def header_word(self, number: int) -> int:
        """Return a word of the header, counted from 1."""
        return int(np.frombuffer(self.header, f"{self.processor.order}u2")[number - 1])

    def header_number(self, number: int) -> float:
        """Return the floating-point number that begins with a word of the header."""
        at = 2 * (number - 1)
        return float(self._floats(self.header[at : at + 4])[0])

    def numbers(self, name: str) -> list[float]:
        """Return the numbers of a parameter; integers have no sign. Without it, there are none."""
        kind, _, data = self.values.get(name, _NOTHING)
        whole = data[: len(data) // abs(kind) * abs(kind)] if kind else data
        if kind == FLOAT:
            return [float(number) for number in self._floats(whole)]
        if kind in (BYTE, WORD):
            words = np.frombuffer(whole, f"{self.processor.order}u{kind}")
            return [float(word) for word in words]
        return []

    def texts(self, name: str) -> Iterator[str]:
        """Yield the texts of a parameter, and of those that continue it: LABELS, LABELS2, ..."""
        names = (name if number == 1 else f"{name}{number}" for number in count(1))
        for one in takewhile(self.values.__contains__, names):
            kind, dimensions, data = self.values[one]
            width = dimensions[0] if dimensions else 1
            if kind == TEXT and width:
                padded = (bytes(data[at : at + width]) for at in range(0, len(data), width))
                yield from (decode_text(text.strip(b" \0")) for text in padded)

    def _floats(
        self, data: bytes | memoryview
    ) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
        return self.processor.decode(np.frombuffer(data, self.processor.stored))


def read_parameters(path: Path) -> C3DParameters:
    """Return the header and the parameters of a file.

    Raises
    ------
    FormatError
        If it has no header of a C3D file, or the computer that its numbers are of is unknown.
    """
    advice = "export the recording again as C3D"
    with path.open("rb") as stream:
        header = stream.read(BLOCK)
        if len(header) < BLOCK or header[1] != _MAGIC:
            got = f"{header[:8]!r}" if header else "an empty file"
            raise FormatError(path.name, "the header of a C3D file", got, advice)
        start = max(header[0] - 1, 0) * BLOCK
        stream.seek(start)
        section = memoryview(stream.read(_MOST_BLOCKS * BLOCK))
    processor = section[3] if len(section) > 3 else 0
    if processor not in PROCESSORS:
        expected = "numbers of Intel, DEC or MIPS computers (84, 85 or 86) in its parameters"
        raise FormatError(path.name, expected, f"the type {processor}", advice)
    found = PROCESSORS[processor]
    stop = start + max(section[2], 1) * BLOCK
    return C3DParameters(header, found, start, stop, _named_values(section, found.order))


def _named_values(section: memoryview, order: str) -> dict[str, Values]:
    """Return the values of the parameters; of two with one name, those of the first."""
    groups: dict[int, str] = {}
    values: dict[tuple[int, str], Values] = {}
    for group, name, content in _records(section, order):
        if group < 0:
            groups.setdefault(-group, name)
        else:
            values.setdefault((group, name), _values_of(content))
    named: dict[str, Values] = {}
    for (group, name), one in values.items():
        named.setdefault(f"{groups.get(group, '')}:{name}", one)
    return named


def _records(section: memoryview, order: str) -> Iterator[tuple[int, str, memoryview]]:
    """Yield the group, the name and the rest of each record.

    The next record is where the distance says, as some programs get the length of a description or
    the number of values wrong. For the same reason the number of blocks, in the section's third
    byte, does not end it.
    """
    at = 4
    while at + 2 <= len(section):
        length, group = np.frombuffer(section, np.int8, 2, at).tolist()
        distance_at = at + 2 + abs(length)
        content_at = distance_at + 2
        if length == 0 or group == 0 or content_at > len(section):
            return
        name = bytes(section[at + 2 : distance_at]).decode("ascii", "replace").strip().upper()
        yield group, name, section[content_at:]
        distance = int(np.frombuffer(section, f"{order}u2", 1, distance_at)[0])
        if distance == 0:  # the last one
            return
        at = distance_at + distance


def _values_of(content: memoryview) -> Values:
    kind, n_dimensions = (
        np.frombuffer(content[:2], np.int8).tolist() if len(content) > 1 else (0, 0)
    )
    first = 2 + max(n_dimensions, 0)
    dimensions = tuple(content[2:first])
    return kind, dimensions, content[first : first + abs(kind) * prod(dimensions)]
