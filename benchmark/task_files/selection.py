"""The part of a recording that takes part: frames and channels."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from mocapbench.datasets import Recording

__all__ = ["Span", "matching_channels", "parse_span", "select_part"]

Span = tuple[int, int | None]
"""The first frame, counted from 0, and the one after the last; None stands for the end."""


def parse_span(text: str) -> Span:
    """Return the span that ``text`` such as ``120:180`` stands for.

    Raises
    ------
    ValueError
        If it stands for none, or for one without frames.

    Examples
    --------
    >>> from mocapbench.benchmark.task_files.selection import parse_span
    >>> parse_span("120:180")
    (120, 180)
    >>> parse_span("120:")
    (120, None)
    """
    found = re.fullmatch(r"(\d*):(\d*)", text)
    if not found:
        raise ValueError(f"{text!r} is not a span of frames")
    start, stop = int(found[1] or 0), int(found[2]) if found[2] else None
    if stop is not None and stop <= start:
        raise ValueError(f"{text!r} has no frames")
    return start, stop


def select_part(
    recording: Recording, /, frames: Span = (0, None), channels: Sequence[str] = ()
) -> Recording:
    """Return a part of a recording, without frames or channels if none fits.

    Parameters
    ----------
    recording : Recording
    frames : tuple of int
        Where they end beyond the recording, all that there are.
    channels : sequence of str
        Regular expressions of whole names of channels; none stands for all channels.
    """
    cut = recording.frames(np.arange(len(recording.times))[slice(*frames)])
    return cut.select(matching_channels(channels, recording.channels))


def matching_channels(patterns: Sequence[str], channels: Sequence[str]) -> tuple[str, ...]:
    """Return those ``channels`` whose whole name fits a pattern; all of them without patterns."""
    if not patterns:
        return tuple(channels)
    return tuple(name for name in channels if any(re.fullmatch(p, name) for p in patterns))
