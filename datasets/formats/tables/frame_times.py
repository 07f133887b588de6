"""The times of frames: by a column of times, or by a rate and a count of frames."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.formats.errors import FormatError, FormatWarning
from mocapbench.datasets.recording import Frames

__all__ = ["FrameTimes", "lacking_rows"]

_SECONDS = {"s": 1.0, "m": 1e-3, "μ": 1e-6, "n": 1e-9}
_NAMES = {"m": "milliseconds", "μ": "microseconds", "n": "nanoseconds"}
_LARGEST_STEPS = {"s": 2.0, "m": 1e3, "μ": 1e6}
"""Below these, times without a unit are in that one: of 0.5 to 1000 frames a second."""
_REGULAR, _JUMP = 0.3, 1.7
"""Of the usual step: how far others are from multiples, and from which on a row is missing."""
_MOSTLY = 0.9
"""Of steps that are near a multiple: below, times are uneven, and tell of no missing row."""
_AGREEING = 0.01
_HUGE = 1e15  # counts beyond are no whole numbers of a double


class FrameTimes(NamedTuple):
    """What a table says about the times of its N frames.

    Parameters
    ----------
    file : str
    times : ndarray of shape (N,) or None
        A column of times, in its own unit.
    unit : str
        The unit that its name states: s, m, μ or n, or nothing.
    frames : ndarray of shape (N,) or None
        A column that counts the frames.
    rate : float or None
        Frames per second, as the head says.
    names : sequence of str
        Of all columns.
    """

    file: str
    times: Frames | None
    unit: str
    frames: Frames | None
    rate: float | None
    names: Sequence[str]

    def seconds(self, n_frames: int, rate: float | None) -> Frames:
        """Return the times of the frames.

        Parameters
        ----------
        n_frames : int
        rate : float or None
            Rows per second, in place of what the table says.

        Raises
        ------
        FormatError
            If nothing says them.
        """
        count = np.arange(float(n_frames))
        counted = count if self.frames is None or not _counts(self.frames) else self.frames
        counted = counted - counted[:1].sum()
        if rate is not None:
            return np.asarray(counted / _most_common_step(counted) / rate)
        if self.times is not None:
            return self._by_column(self.times)
        if self.rate is None:
            advice = "name the rate in frames per second, such as --rate 100"
            expected = "a column 'time' in seconds, or a rate"
            some = ", ".join(name or "''" for name in self.names[:4])
            got = f"the columns {some}{', …' if len(self.names) > 4 else ''}"
            raise FormatError(self.file, expected, got, advice)
        return np.asarray(counted / self.rate)

    def _by_column(self, times: Frames) -> Frames:
        unit = self.unit or _guess_unit(times)
        if unit != "s" and not self.unit:
            step = _usual_step(times)
            warnings.warn(
                f"{self.file}: steps of times are {step:g}, so they are taken for {_NAMES[unit]}; "
                f"name the rate with --rate if they are not",
                FormatWarning,
                stacklevel=2,
            )
        seconds = times * _SECONDS[unit]
        self._compare_rates(seconds)
        return seconds

    def _compare_rates(self, seconds: Frames) -> None:
        rate = 1.0 / _usual_step(seconds) if len(seconds) > 1 else self.rate
        if self.rate and rate and abs(rate - self.rate) > _AGREEING * self.rate + 1e-3 * rate**2:
            warnings.warn(
                f"{self.file}: expected {self.rate:g} frames per second, as its head says, got "
                f"{rate:.5g} by its times, which are taken; name the right one with --rate",
                FormatWarning,
                stacklevel=2,
            )


def lacking_rows(frames: Frames | None, times: Frames | None) -> NDArray[np.intp]:
    """Return how many rows are missing behind each of N rows but the last, (N − 1,).

    A count of frames says it, or else times, if their steps are about multiples of the usual one.
    """
    if frames is not None and _counts(frames):
        return _count_lacking(np.diff(frames) / _most_common_step(frames))
    steps = np.diff(times) if times is not None else np.empty(0)
    usual = np.median(steps) if len(steps) else 0.0
    if times is None or not np.isfinite(steps).all() or not usual > 0:
        return np.zeros(0 if times is None else len(steps), dtype=np.intp)
    whole = np.maximum(np.round(steps / usual), 1.0)
    regular = np.abs(steps / usual - whole) <= _REGULAR
    if regular.mean() < _MOSTLY:
        return np.zeros(len(steps), dtype=np.intp)
    return _count_lacking(np.where(steps / usual >= _JUMP, steps / usual, 1.0))


def _count_lacking(steps: Frames) -> NDArray[np.intp]:
    """Return how many frames are missing within steps, in units of the usual one."""
    return np.minimum(np.round(steps) - 1.0, _HUGE).clip(0).astype(np.intp)


def _counts(frames: Frames) -> bool:
    """Return whether they are whole numbers that rise."""
    known = np.isfinite(frames).all() and (np.abs(frames) < _HUGE).all()
    return bool(known and (np.diff(frames) > 0).all() and (frames == np.round(frames)).all())


def _most_common_step(frames: Frames) -> float:
    """Return the step between most frames, of whole numbers that rise."""
    steps, counts = np.unique(np.diff(frames), return_counts=True)
    return float(steps[counts.argmax()]) if len(steps) else 1.0


def _usual_step(values: Frames) -> float:
    """Return the median of the steps, or 1 if it is not above 0."""
    steps = np.diff(values[np.isfinite(values)])
    step = float(np.median(steps)) if len(steps) else 1.0
    return step if step > 0 else 1.0


def _guess_unit(times: Frames) -> str:
    step = _usual_step(times) if len(times) > 1 else 0.0
    return next((unit for unit, largest in _LARGEST_STEPS.items() if step < largest), "n")
