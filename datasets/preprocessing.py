"""Choosing frames of a recording, and stating the root's path as differences.

Every function returns a new `Recording`. Frames keep their times, except in `restart`.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.recording import Recording

__all__ = [
    "integrate_root",
    "one_based_frames",
    "resample",
    "restart",
    "root_differences",
    "zero_based_frames",
]

_ROOT_PATH = ("root.tx", "root.ty", "root.tz")
_ROOT_VELOCITY = ("root.dtx", "root.dty", "root.dtz")


def zero_based_frames(recording: Recording, start: int, stop: int) -> Recording:
    """Return frames ``start`` to ``stop``, counted from 0 and without ``stop``, as Python counts.

    The convention for windows of J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes
    for Human Motion Data*, MSc thesis, Universidad Tecnológica de Pereira, 2017, footnotes 5 to 7.
    A window that goes beyond the end of the recording is cut there.

    Parameters
    ----------
    recording : Recording
    start, stop : int
        ``0 <= start < stop``; ``start`` lies within the recording.

    Raises
    ------
    ValueError
        If the recording has none of the frames.

    See Also
    --------
    one_based_frames : The other way to count.
    """
    frames = np.arange(len(recording.times))[start:stop]
    if not 0 <= start < stop or not len(frames):
        raise ValueError(
            f"recording {recording.name!r}: expected a window 0 <= start < stop that begins within "
            f"its {len(recording.times)} frames, got [{start}, {stop})"
        )
    return recording.frames(frames)


def one_based_frames(recording: Recording, first: int, last: int) -> Recording:
    """Return frames ``first`` to ``last``, counted from 1 and with ``last``.

    The convention of Wang, Fleet and Hertzmann (2008), Gaussian process dynamical models for human
    motion (GPDM), §5.4.

    Parameters
    ----------
    recording : Recording
    first, last : int
        ``1 <= first <= last <= N``.

    Raises
    ------
    ValueError
        If the recording does not have all of the frames.

    See Also
    --------
    zero_based_frames : The other way to count.
    """
    if not 1 <= first <= last <= len(recording.times):
        raise ValueError(
            f"recording {recording.name!r}: expected frames within 1 to {len(recording.times)}, "
            f"got {first} to {last}"
        )
    return zero_based_frames(recording, first - 1, last)


def resample(recording: Recording, n_frames: int) -> Recording:
    """Return ``n_frames`` of the frames, evenly spaced from the first to the last.

    Their indices are ``round(linspace(0, N - 1, n_frames))``.

    Raises
    ------
    ValueError
        If the recording has fewer.
    """
    available = len(recording.times)
    if not 1 <= n_frames <= available:
        raise ValueError(
            f"recording {recording.name!r}: expected to choose 1 to {available} of its frames, "
            f"got {n_frames}"
        )
    return recording.frames(np.round(np.linspace(0, available - 1, n_frames)))


def restart(recording: Recording) -> Recording:
    """Return the recording with its times counted from its first frame.

    Times are rounded to nanoseconds, so that windows of equal length have exactly equal times,
    wherever they began.
    """
    return replace(recording, times=np.round(recording.times - recording.times[0], 9))


def root_differences(recording: Recording) -> Recording:
    """Return the recording with the root's translation as differences, ``root.dtx`` and so on.

    The difference of a frame is next minus current; the last frame repeats the one before.

    Raises
    ------
    ValueError
        If there is only one frame, or a channel of the root's translation is missing.
    """
    columns = _columns(recording, _ROOT_PATH)
    if len(recording.times) < 2:
        raise ValueError(f"recording {recording.name!r}: expected two frames or more, got one")
    values = recording.values.copy()
    values[:-1, columns] = np.diff(values[:, columns], axis=0)
    values[-1, columns] = values[-2, columns]
    return _rename_channels(recording, values, dict(zip(_ROOT_PATH, _ROOT_VELOCITY, strict=True)))


def integrate_root(recording: Recording) -> Recording:
    """Return the recording with the root's path summed from its differences, from the origin.

    The inverse of `root_differences`, except that the path starts at the origin.

    Raises
    ------
    ValueError
        If a channel of the root's differences is missing.
    """
    columns = _columns(recording, _ROOT_VELOCITY)
    values = recording.values.copy()
    values[1:, columns] = np.cumsum(values[:-1, columns], axis=0)
    values[0, columns] = 0.0
    return _rename_channels(recording, values, dict(zip(_ROOT_VELOCITY, _ROOT_PATH, strict=True)))


def _columns(recording: Recording, channels: tuple[str, ...]) -> list[int]:
    missing = [name for name in channels if name not in recording.channels]
    if missing:
        raise ValueError(f"recording {recording.name!r} has no channels {missing}")
    return [recording.channels.index(name) for name in channels]


def _rename_channels(
    recording: Recording, values: NDArray[np.float64], names: dict[str, str]
) -> Recording:
    channels = tuple(names.get(name, name) for name in recording.channels)
    return replace(recording, values=values, channels=channels)
