"""BVH (Biovision hierarchy): joints, and the angles and positions of each at every frame."""

# Why not by a library: pybvh 0.9 writes six decimals, whatever the file had.

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from contextlib import suppress
from math import isfinite
from pathlib import Path
from typing import ClassVar

from mocapbench.datasets.formats.base import Format
from mocapbench.datasets.formats.building import even_times, recording_of
from mocapbench.datasets.formats.errors import FormatError, FormatWarning
from mocapbench.datasets.formats.text.cells import Words
from mocapbench.datasets.formats.text.lines import read_lines, write_lines
from mocapbench.datasets.formats.text.numbers import numeric
from mocapbench.datasets.formats.text.rows import SpacedTable, TextTable
from mocapbench.datasets.recording import FrameByChannel, Mask, Recording

__all__ = ["BVHFormat"]

_CHANNELS = {
    f"{axis}{kind}": (letter + axis, unit)
    for kind, letter, unit in (("position", "t", ""), ("rotation", "r", "deg"), ("scale", "s", ""))
    for axis in "xyz"
}
"""Suffix of the channel's name, and unit; the format does not state that of positions."""
_LONGEST_FRAME = 2.0
"""Seconds; what is stated as more is in milliseconds."""


class BVHFormat(Format):
    """Joints of a hierarchy (.bvh) with any channels: positions, rotations or both.

    The channels are ``Hips.tx``, ``Hips.rz``, ``LeftKnee.rx`` and so on, in the order of the file;
    rotations are in degrees. The word ``nan`` is a hidden entry, which some programs write; in
    other files the gaps are those that the user names. All rows are read, with a warning if
    they are more than the file states, or one fewer. Words may be in upper or lower case, and
    numbers may have decimal commas. Every line keeps its numbers, but for those that are filled.
    """

    suffixes: ClassVar[tuple[str, ...]] = (".bvh",)
    memory_per_byte: ClassVar[float] = 12.0

    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has."""
        channels, (n_frames, frame_time), table = _parse(path)
        values = table.numbers(range(table.width))
        _check_count(path.name, n_frames, len(values))
        times = even_times(len(values), rate or 1.0 / _frame_seconds(path.name, frame_time))
        names, units = [name for name, _ in channels], [unit for _, unit in channels]
        return recording_of(path.name, times, values, names, units)

    def save(self, path: Path, values: FrameByChannel, new: Mask, like: Path) -> None:
        """Write the file's lines with the new numbers."""
        _, _, table = _parse(like)
        write_lines(path, table.with_numbers(range(table.width), values, new), like)


class _Lines:
    """The lines that are not blank, one after another, for errors that name them."""

    def __init__(self, file: str, lines: Sequence[str]) -> None:
        self.file = file
        self.index = 0
        self._content = (
            (k, words)
            for k, line in enumerate(lines)
            for words in _split_brace(line.split())
            if words
        )

    def __iter__(self) -> Iterator[list[str]]:
        for index, words in self._content:
            self.index = index
            yield words

    def error(self, expected: str, words: Sequence[str]) -> FormatError:
        """Return an error for the line that was taken last."""
        got = repr(" ".join(words)[:60]) if words else "the end of the file"
        advice = "export the recording again as BVH"
        return FormatError(self.file, expected, got, advice, self.index + 1)


def _split_brace(words: list[str]) -> tuple[list[str], ...]:
    """Return the words of a line, and apart from them a brace that ends it."""
    return (words[:-1], words[-1:]) if words[-1:] == ["{"] else (words,)


def _parse(path: Path) -> tuple[list[tuple[str, str]], tuple[float, float], TextTable]:
    """Return names and units of the channels, number and time of frames as stated, and the rows."""
    text = read_lines(path)
    lines = _Lines(path.name, text)
    channels = list(_hierarchy(lines))
    stated = _positive(lines, "Frames:"), _positive(lines, "Frame Time:")
    width, start = len(channels), lines.index + 1
    decimal = "," if "," in "".join(text[start : start + 1]) else "."
    return channels, stated, SpacedTable(path.name, text, start, Words(), width, width, decimal)


def _frame_seconds(file: str, frame_time: float) -> float:
    """Return the seconds of a frame, with a warning if milliseconds seem to be stated."""
    if frame_time < _LONGEST_FRAME:
        return frame_time
    warnings.warn(
        f"{file}: 'Frame Time:' is {frame_time:g}, so it is taken for milliseconds; name the rate "
        "with --rate if it is not",
        FormatWarning,
        stacklevel=2,
    )
    return frame_time / 1000.0


def _check_count(file: str, stated: float, n_rows: int) -> None:
    """Warn of rows that are not stated, or of one that is missing; refuse a file that lacks more.

    Rokoko counts the steps between frames, which are one fewer.
    """
    expected, got = f"{stated:g} frames, as 'Frames:' says", f"{n_rows} rows"
    if n_rows < stated - 1:
        advice = "the file may be cut short: export it again, or correct 'Frames:'"
        raise FormatError(file, expected, got, advice)
    if n_rows != stated:
        warnings.warn(
            f"{file}: expected {expected}, got {got}, which are read", FormatWarning, stacklevel=2
        )


def _hierarchy(lines: _Lines) -> Iterator[tuple[str, str]]:
    """Yield name and unit of every channel, up to the line ``MOTION``."""
    joint, depth = "", 0
    for words in lines:
        match [words[0].upper(), *words[1:]]:
            case ["HIERARCHY"] | ["END", *_]:
                pass
            case ["OFFSET", *offset] if len(offset) == 3:
                pass
            case ["ROOT" | "JOINT", *name] if name:
                joint = " ".join(name)
            case ["{"]:
                depth += 1
            case ["}"] if depth:
                depth -= 1
            case ["CHANNELS", count, *kinds] if count == str(len(kinds)) and all(
                kind.lower() in _CHANNELS for kind in kinds
            ):
                found = (_CHANNELS[kind.lower()] for kind in kinds)
                yield from ((f"{joint}.{suffix}", unit) for suffix, unit in found)
            case ["MOTION"] if not depth:
                return
            case _:
                raise lines.error("a hierarchy of joints with OFFSET and CHANNELS", words)
    raise lines.error("'MOTION' below the hierarchy", [])


def _positive(lines: _Lines, label: str) -> float:
    """Return the number that follows a label on the next line, whatever blanks are between."""
    words = next(iter(lines), [])
    joined, start = "".join(words).lower().replace(",", "."), label.replace(" ", "").lower()
    with suppress(ValueError):
        (value,) = numeric([joined.removeprefix(start)])
        if joined.startswith(start) and isfinite(value) and value > 0:
            return value
    raise lines.error(f"'{label}' with a positive number", words)
