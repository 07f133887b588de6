"""What a task file says it hides: the table ``hide``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from mocapbench.benchmark.task_files.document import Document
from mocapbench.benchmark.task_files.hiding import (
    Hiding,
    group_columns,
    hide_entries,
    hide_gaps,
    hide_same_gaps,
    hide_spans,
)
from mocapbench.benchmark.task_files.values import (
    is_count,
    is_path,
    is_positive,
    read_channels,
    read_spans,
)

__all__ = ["HIDE_KEYS", "RUN_KEYS", "Hidden", "Variant", "read_hidden"]

HIDE_KEYS = ("frames", "fraction", "runs", "pattern-of", "channels")
RUN_KEYS = ("seconds", "count", "together")
_TOGETHER = ("all", "joint", "channel")

Variant = tuple[str, Mapping[str, float], Hiding]
"""One of the problems that a task poses of every recording."""


@dataclass(frozen=True)
class Hidden:
    """What a task hides.

    Parameters
    ----------
    variants : tuple of Variant
        Each has a name, empty if there is but one; the same as columns of the table; and the way
        to hide.
    whole_frames : bool
        Whether all channels are hidden wherever one is.
    whole_channels : bool
        Whether a channel is hidden from end to end, so that only other recordings tell of it.
    scattered : bool
        Whether entries are hidden one by one.
    pattern : str
        Path of the file whose gaps are hidden, below the folder of recordings; mostly empty.
    repeats : bool
        Whether every fold hides the same.
    lengths : tuple of float
        Seconds of gaps at random places; mostly none.
    """

    variants: tuple[Variant, ...]
    whole_frames: bool = False
    whole_channels: bool = False
    scattered: bool = False
    pattern: str = ""
    repeats: bool = False
    lengths: tuple[float, ...] = ()


def read_hidden(document: Document, address: Callable[[str], str]) -> Hidden:
    """Return what a document hides.

    Parameters
    ----------
    document : Document
    address : callable
        From the path of a file to the address of the recording.

    Raises
    ------
    TaskFileError
        At the first key that is not as expected.
    """
    if not isinstance(document.get("hide"), Mapping) or not document.get("hide"):
        advice = "write for example [hide] and below it fraction = 0.2"
        raise document.error("hide", "a table of what is hidden", "none", advice)
    document.require_known("hide", HIDE_KEYS)
    channels = read_channels(document, "hide.channels")
    readers: Mapping[str, Callable[[Document, tuple[str, ...]], Hidden]] = {
        "frames": _read_frames,
        "fraction": _read_fraction,
        "runs": _read_runs,
        "pattern-of": partial(_read_pattern, address=address),
    }
    ways = [way for way in readers if way in document.get("hide")]
    if len(ways) > 1:
        advice = f"remove all but one, or write a task file for each; got {ways}"
        expected = f"one of {', '.join(readers)}"
        raise document.error(f"hide.{ways[1]}", expected, f"{len(ways)}", advice)
    return readers[ways[0]](document, channels) if ways else _hide_throughout(channels)


def _hide_throughout(channels: tuple[str, ...]) -> Hidden:
    hide = partial(hide_spans, spans=((0, None),), channels=channels)
    return Hidden((("", {}, hide),), whole_channels=True, repeats=True)


def _read_frames(document: Document, channels: tuple[str, ...]) -> Hidden:
    spans = read_spans(document, "hide.frames", [])
    hide = partial(hide_spans, spans=spans, channels=channels)
    return Hidden((("", {}, hide),), whole_frames=not channels, repeats=True)


def _read_pattern(
    document: Document, channels: tuple[str, ...], address: Callable[[str], str]
) -> Hidden:
    path = document.read("hide.pattern-of", "", is_path, "a file of the folder", '"gaps.csv"')
    hide = partial(hide_same_gaps, uri=address(path), channels=channels)
    return Hidden((("", {}, hide),), pattern=path)


def _read_fraction(document: Document, channels: tuple[str, ...]) -> Hidden:
    shares = _numbers(
        document, "hide.fraction", _is_share, "a share between 0 and 1, or a list", "0.2"
    )
    hidings = {share: partial(hide_entries, share=share, channels=channels) for share in shares}
    return Hidden(_variants(hidings, "hidden", "of entries"), scattered=True)


def _read_runs(document: Document, channels: tuple[str, ...]) -> Hidden:
    if not isinstance(document.get("hide.runs"), Mapping):
        advice = "write for example runs = { seconds = [0.1, 0.5], count = 3 }"
        got = repr(document.get("hide.runs"))
        raise document.error("hide.runs", "a table of seconds and count", got, advice)
    document.require_known("hide.runs", RUN_KEYS)
    if document.get("hide.runs.seconds") is None:
        advice = "write for example seconds = [0.1, 0.5]"
        raise document.error("hide.runs.seconds", "lengths of gaps", "none", advice)
    lengths = _numbers(
        document, "hide.runs.seconds", is_positive, "a length in seconds, or a list", "[0.1, 0.5]"
    )
    count = document.read("hide.runs.count", 1, is_count, "a whole number from 1 to 10,000", "3")
    together = document.read(
        "hide.runs.together", "all", _TOGETHER.__contains__, f"one of {_TOGETHER}", '"joint"'
    )
    group = partial(group_columns, together=together, channels=channels)
    hide = partial(hide_gaps, count=count, group=group)
    gaps = {length: partial(hide, seconds=length) for length in lengths}
    whole_frames = together == "all" and not channels
    return Hidden(_variants(gaps, "seconds", "s"), whole_frames=whole_frames, lengths=lengths)


def _variants(hidings: Mapping[float, Hiding], column: str, unit: str) -> tuple[Variant, ...]:
    """Return a variant for each value; the value is its name if there are several."""
    if len(hidings) == 1:
        return tuple(("", {}, hide) for hide in hidings.values())
    return tuple((f"{value:g} {unit}", {column: value}, hide) for value, hide in hidings.items())


def _numbers(
    document: Document, key: str, fits: Callable[[Any], bool], expected: str, example: str
) -> tuple[float, ...]:
    """Return different numbers, of a list or of one."""

    def all_fit(value: Any) -> bool:
        numbers = _list_values(value)
        return bool(numbers) and all(map(fits, numbers)) and len({*numbers}) == len(numbers)

    return tuple(map(float, _list_values(document.read(key, [], all_fit, expected, example))))


def _list_values(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [value]


def _is_share(value: Any) -> bool:
    return is_positive(value) and value < 1
