"""The part of a recording that takes part: frames and channels."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mocapbench.datasets import Recording

__all__ = ["Selection", "Span", "matching_channels"]


@dataclass(frozen=True)
class Span:
    """Frames from ``start`` to before ``stop``, counted from 0; None stands for the end.

    Examples
    --------
    >>> from mocapbench.benchmark.task_files.selection import Span
    >>> Span.of_text("120:180")
    Span(start=120, stop=180)
    >>> Span.of_text("120:")
    Span(start=120, stop=None)
    """

    start: int = 0
    stop: int | None = None

    @classmethod
    def of_text(cls, text: str) -> Span:
        """Return the span that ``text`` such as ``120:180`` stands for.

        Raises
        ------
        ValueError
            If it stands for none, or for one without frames.
        """
        found = re.fullmatch(r"(\d*):(\d*)", text)
        if not found:
            raise ValueError(f"{text!r} is not a span of frames")
        span = cls(int(found[1] or 0), int(found[2]) if found[2] else None)
        if span.stop is not None and span.stop <= span.start:
            raise ValueError(f"{text!r} has no frames")
        return span

    @property
    def slice(self) -> slice:
        """The span as Python writes it."""
        return slice(self.start, self.stop)

    def within(self, n_frames: int) -> bool:
        """Return whether a recording of ``n_frames`` has all of it."""
        return self.start < n_frames and (self.stop is None or self.stop <= n_frames)


@dataclass(frozen=True)
class Selection:
    """What is taken of every recording.

    Parameters
    ----------
    frames : Span
        Where it ends beyond a recording, all that there is.
    channels : tuple of str
        Regular expressions of whole names of channels; none stands for all channels.
    """

    frames: Span = Span()
    channels: tuple[str, ...] = ()

    def of(self, recording: Recording) -> Recording:
        """Return the selected part of a recording, without frames or channels if none fits."""
        cut = recording.frames(np.arange(len(recording.times))[self.frames.slice])
        return cut.select(matching_channels(self.channels, recording.channels))


def matching_channels(patterns: Sequence[str], channels: Sequence[str]) -> tuple[str, ...]:
    """Return those ``channels`` whose whole name fits a pattern; all of them without patterns."""
    if not patterns:
        return tuple(channels)
    return tuple(name for name in channels if any(re.fullmatch(p, name) for p in patterns))
