"""BVH (Biovision hierarchy): joints, and the angles and positions of each at every frame."""

# Why not by a library: pybvh 0.9 writes six decimals, whatever the file had.

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from contextlib import suppress
from math import isfinite
from pathlib import Path

from mocapbench.datasets.formats.base import Format
from mocapbench.datasets.formats.building import even_times, recording_of
from mocapbench.datasets.formats.errors import FormatError, FormatWarning
from mocapbench.datasets.formats.text.cells import Words
from mocapbench.datasets.formats.text.lines import read_lines, write_lines
from mocapbench.datasets.formats.text.numbers import numeric
from mocapbench.datasets.formats.text.rows import TextTable
from mocapbench.datasets.recording import FrameByChannel, Mask, Recording

__all__ = ["BVHFormat"]

_CHANNELS = {
    "Xposition": ("tx", ""),
    "Yposition": ("ty", ""),
    "Zposition": ("tz", ""),
    "Xrotation": ("rx", "deg"),
    "Yrotation": ("ry", "deg"),
    "Zrotation": ("rz", "deg"),
}
"""Suffix of the channel's name, and unit; the format does not state that of positions."""


class BVHFormat(Format):
    """Joints of a hierarchy (.bvh) with any channels: positions, rotations or both.

    The channels are ``Hips.tx``, ``Hips.rz``, ``LeftKnee.rx`` and so on, in the order of the file;
    rotations are in degrees. The word ``nan`` is a hidden entry, which some programs write; in
    other files the gaps are those that the user names. All rows are read, with a warning if
    they are more than the file states, or one fewer. Every line keeps its numbers, but for those
    that are filled.
    """

    suffixes = (".bvh",)
    memory_per_byte = 12.0

    def load(self, path: Path, rate: float | None) -> Recording:
        """Return the recording with the values that the file has."""
        channels, (n_frames, frame_time), table = _parse(path)
        values = table.numbers(range(table.width))
        _check_count(path.name, n_frames, len(values))
        times = even_times(len(values), rate or 1.0 / frame_time)
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
        self._content = ((k, line.split()) for k, line in enumerate(lines) if line.strip())

    def __iter__(self) -> Iterator[list[str]]:
        for index, words in self._content:
            self.index = index
            yield words

    def error(self, expected: str, words: Sequence[str]) -> FormatError:
        """Return an error for the line that was taken last."""
        got = repr(" ".join(words)[:60]) if words else "the end of the file"
        advice = "export the recording again as BVH"
        return FormatError(self.file, expected, got, advice, self.index + 1)


def _parse(path: Path) -> tuple[list[tuple[str, str]], tuple[float, float], TextTable]:
    """Return names and units of the channels, number and time of frames as stated, and the rows."""
    text = read_lines(path)
    lines = _Lines(path.name, text)
    channels = list(_hierarchy(lines))
    stated = _positive(lines, "Frames:"), _positive(lines, "Frame", "Time:")
    width = len(channels)
    return channels, stated, TextTable(path.name, text, lines.index + 1, Words(), width, width)


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
        match words:
            case ["HIERARCHY"] | ["End", "Site"]:
                pass
            case ["OFFSET", *offset] if len(offset) == 3:
                pass
            case ["ROOT" | "JOINT", *name] if name:
                joint = " ".join(name)
            case ["{"]:
                depth += 1
            case ["}"] if depth:
                depth -= 1
            case ["CHANNELS", count, *kinds] if count == str(len(kinds)) and _CHANNELS.keys() >= {
                *kinds
            }:
                yield from ((f"{joint}.{_CHANNELS[kind][0]}", _CHANNELS[kind][1]) for kind in kinds)
            case ["MOTION"] if not depth:
                return
            case _:
                raise lines.error("a hierarchy of joints with OFFSET and CHANNELS", words)
    raise lines.error("'MOTION' below the hierarchy", [])


def _positive(lines: _Lines, *label: str) -> float:
    """Return the number that follows a label on the next line."""
    words = next(iter(lines), [])
    with suppress(ValueError):
        (value,) = numeric(words[len(label) :])
        if words[: len(label)] == [*label] and isfinite(value) and value > 0:
            return value
    raise lines.error(f"'{' '.join(label)}' with a positive number", words)
