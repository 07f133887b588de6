"""Whether recordings of several files belong together: the same channels, units and rate."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.recording import Recording

__all__ = ["check_alike", "frame_rate", "same_rate"]

_TOLERANCE = 0.01
"""Of rates: files state 1/30 s as 0.033 or 0.033333."""


def frame_rate(recording: Recording) -> float:
    """Return the frames per second, or NaN if there is but one frame.

    It is one over the mean of the steps within ±50 % of their median. Times that were rounded to
    milliseconds do not affect the mean, and frames that are missing do not count.

    Examples
    --------
    >>> from mocapbench.datasets import Recording, frame_rate
    >>> times = [0.0, 0.033, 0.067, 0.1, 0.5, 0.533]
    >>> round(frame_rate(Recording("walk", times, [[0.0]] * 6, ["hip"], ["cm"])), 1)
    30.1
    """
    steps = np.diff(recording.times)
    if not len(steps):
        return float("nan")
    usual = np.abs(steps / np.median(steps) - 1.0) <= 0.5
    return float(1.0 / steps[usual].mean())


def same_rate(first: Recording, other: Recording) -> bool:
    """Return whether frame rates differ by at most 1 %; that of a single frame may be any."""
    one, two = frame_rate(first), frame_rate(other)
    return not abs(two - one) > _TOLERANCE * one  # never so for the NaN of a single frame


def check_alike(recordings: Sequence[Recording]) -> None:
    """Refuse recordings that no model can learn from together.

    Parameters
    ----------
    recordings : sequence of Recording
        The first is what the others must be like.

    Raises
    ------
    FormatError
        If channels or units of two differ, or their rates do by more than 1 %.
    """
    first, *others = recordings
    for other in others:
        _check_channels(first, other)
        _check_units(first, other)
        _check_rates(first, other)


def _check_channels(first: Recording, other: Recording) -> None:
    if first.channels == other.channels:
        return
    missing = sorted(set(first.channels) - set(other.channels))
    added = sorted(set(other.channels) - set(first.channels))
    differences = (_some("no", missing), _some("besides", added))
    raise FormatError(
        other.name,
        f"the {len(first.channels)} channels of {first.name}",
        ", ".join(filter(None, differences)) or "another order",
        "use files of one marker set or skeleton together",
    )


def _check_units(first: Recording, other: Recording) -> None:
    for channel, one, two in zip(first.channels, first.units, other.units, strict=True):
        if one != two:
            raise FormatError(
                other.name,
                f"{channel} in {one or 'no unit'}, as in {first.name}",
                two or "no unit",
                "convert one of the files",
            )


def _check_rates(first: Recording, other: Recording) -> None:
    if not same_rate(first, other):
        raise FormatError(
            other.name,
            f"{frame_rate(first):.6g} frames per second, as in {first.name}",
            f"{frame_rate(other):.6g}",
            "resample one of the files, or name the rate if its times are wrong",
        )


def _some(word: str, names: Sequence[str]) -> str:
    if not names:
        return ""
    more = f" and {len(names) - 3} more" if len(names) > 3 else ""
    return f"{word} {', '.join(names[:3])}{more}"
