"""A recording from the parts of a file, or an error that names the first part that is wrong."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from mocapbench.datasets.formats.errors import FormatError
from mocapbench.datasets.recording import FrameByChannel, Frames, Recording

__all__ = ["even_times", "recording_of"]

_HUGE = 1e100  # far from where arithmetic on the values could overflow


def even_times(n_frames: int, rate: float) -> Frames:
    """Return the times of frames at ``rate`` per second, in seconds from 0."""
    return np.arange(n_frames) / rate


def recording_of(
    file: str,
    times: Frames,
    values: FrameByChannel,
    channels: Sequence[str],
    units: Sequence[str],
) -> Recording:
    """Return a recording named ``file``.

    Parameters
    ----------
    file : str
        Name of the file.
    times : ndarray of shape (N,)
        Seconds.
    values : ndarray of shape (N, D)
        NaN is hidden.
    channels, units : sequence of D str

    Raises
    ------
    FormatError
        If there is no frame or no channel, two channels share a name, a time is not finite or not
        after the one before, or a value is infinite or too large to be a measurement.
    """
    if not len(times) or not channels:
        raise FormatError(
            file,
            "one frame and one channel or more",
            f"{len(times)} frames and {len(channels)} channels",
            "export the recording again",
        )
    _check_names(file, channels)
    _check_times(file, times)
    _check_values(file, values, channels)
    return Recording(file, times, values, tuple(channels), tuple(units))


def _check_names(file: str, channels: Sequence[str]) -> None:
    name, count = Counter(channels).most_common(1)[0]
    if count > 1:
        raise FormatError(
            file, "channels with different names", f"{name!r} {count} times", "rename all but one"
        )


def _check_times(file: str, times: Frames) -> None:
    advice = "correct the times, or name a rate in frames per second in place of them"
    for frame in np.flatnonzero(~np.isfinite(times))[:1]:
        raise FormatError(file, "a time for every frame", f"none for frame {frame}", advice)
    for frame in np.flatnonzero(np.diff(times) <= 0)[:1]:
        raise FormatError(
            file,
            "every time after the one before",
            f"{times[frame + 1]:g} s after {times[frame]:g} s at frame {frame + 1}",
            advice,
        )


def _check_values(file: str, values: FrameByChannel, channels: Sequence[str]) -> None:
    for frame, channel in np.argwhere((values > _HUGE) | (values < -_HUGE))[:1]:
        raise FormatError(
            file,
            f"finite numbers, {-_HUGE:g} to {_HUGE:g}, or nothing where an entry is missing",
            f"{values[frame, channel]:g} at frame {frame} of {channels[channel]}",
            "leave the entry empty",
        )
