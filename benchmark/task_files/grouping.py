"""Which recordings of a folder the first task file is about: the most that are alike."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.formats import read_measured
from mocapbench.benchmark.task_files.finding import readable_files
from mocapbench.benchmark.task_files.library import require_addressable
from mocapbench.datasets import FormatError, Recording, check_alike

__all__ = ["check_alike_in_any_order", "largest_group"]


def largest_group(folder: Path, rate: float | None) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the most files of a folder that are alike, and why others are not among them.

    Of several groups of one size, the one whose first file comes first counts.

    Parameters
    ----------
    folder : Path
    rate : float or None
        Frames per second, in place of what the files say.

    Raises
    ------
    UsageError
        If no recording there can be read.
    """
    recordings, unreadable = _read(folder, rate)
    if not recordings:
        why = "; ".join(unreadable[:3]) or "it has none of a known suffix"
        raise UsageError(
            f"--recordings: expected files in {folder} that can be read, got none: {why}; "
            "`mocapbench list formats` shows what can be read, and --rate 120 gives frames per "
            "second to files without times"
        )
    first = max(_groups(recordings), key=len)[0]
    reasons = {recording.name: _difference(first, recording) for recording in recordings}
    alike = tuple(name for name, reason in reasons.items() if not reason)
    return alike, (*unreadable, *filter(None, reasons.values()))


def check_alike_in_any_order(first: Recording, other: Recording) -> None:
    """Refuse other channels, units or rates; another order of the channels does not matter.

    Raises
    ------
    FormatError
        If they differ.
    """
    same = {*first.channels} == {*other.channels}
    check_alike([first, other.select(first.channels) if same else other])


def _read(folder: Path, rate: float | None) -> tuple[list[Recording], list[str]]:
    """Return the recordings of a folder, and why others cannot be read."""
    recordings, unreadable = [], []
    for path in readable_files(folder):
        try:
            recordings.append(_recording(folder, path, rate))
        except FormatError as error:
            unreadable.append(str(error))
    return recordings, unreadable


def _recording(folder: Path, path: str, rate: float | None) -> Recording:
    require_addressable(path)
    recording = read_measured(folder / path, rate)
    if len(recording.times) < 2:
        raise FormatError(path, "two or more frames", "1", "leave the file out")
    return replace(recording, name=path)


def _groups(recordings: Sequence[Recording]) -> list[list[Recording]]:
    """Return groups of recordings that are each like the first of their group."""
    groups: list[list[Recording]] = []
    for recording in recordings:
        for group in groups:
            if not _difference(group[0], recording):
                group.append(recording)
                break
        else:
            groups.append([recording])
    return groups


def _difference(first: Recording, other: Recording) -> str:
    """Return what keeps two apart, if anything."""
    try:
        check_alike_in_any_order(first, other)
    except FormatError as error:
        return str(error)
    return ""
