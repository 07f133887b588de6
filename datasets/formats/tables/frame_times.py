"""The times of frames: by a column of times, or by a rate and a count of frames."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from mocapbench.datasets.formats.errors import FormatError, FormatWarning
from mocapbench.datasets.formats.missing_rows import counts_frames, most_common_step
from mocapbench.datasets.recording import Frames

__all__ = ["FrameTimes"]

_SECONDS = {"s": 1.0, "m": 1e-3, "μ": 1e-6, "n": 1e-9}
_NAMES = {"m": "milliseconds", "μ": "microseconds", "n": "nanoseconds"}
_LARGEST_STEPS = {"s": 2.0, "m": 1e3, "μ": 1e6}
"""Below these, times without a unit are in that one: of 0.5 to 1000 frames a second."""
_AGREEING = 0.01


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
        counted = count if self.frames is None or not counts_frames(self.frames) else self.frames
        counted = counted - counted[:1].sum()
        if rate is not None:
            return np.asarray(counted / most_common_step(counted) / rate)
        if self.times is not None and not self._are_useless(self.times):
            return self._by_column(self.times)
        if self.rate is None:
            advice = "name the rate in frames per second, such as --rate 100"
            expected = "a column 'time' in seconds, or a rate"
            some = ", ".join(name or "''" for name in self.names[:4])
            got = f"the columns {some}{', …' if len(self.names) > 4 else ''}"
            raise FormatError(self.file, expected, got, advice)
        return np.asarray(counted / self.rate)

    def _are_useless(self, times: Frames) -> bool:
        """Return whether times are all missing or rounded so that some repeat, with a warning.

        Without a rate they are not, as nothing could take their place.
        """
        if self.rate is None or not len(times):
            return False
        told = "missing" if np.isnan(times).all() else _are_rounded(times, self.rate)
        if told:
            warnings.warn(
                f"{self.file}: times are {told}: those of {self.rate:g} frames per second, as the "
                "head says, are taken; name another rate with --rate",
                FormatWarning,
                stacklevel=2,
            )
        return bool(told)

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


def _usual_step(values: Frames) -> float:
    """Return the median of the steps, or 1 if it is not above 0."""
    steps = np.diff(values[np.isfinite(values)])
    step = float(np.median(steps)) if len(steps) else 1.0
    return step if step > 0 else 1.0


def _guess_unit(times: Frames) -> str:
    step = _usual_step(times) if len(times) > 1 else 0.0
    return next((unit for unit, largest in _LARGEST_STEPS.items() if step < largest), "n")


def _are_rounded(times: Frames, rate: float) -> str:
    """Return by how much times are rounded if some repeat, and no more is wrong with them."""
    steps = np.diff(times)
    if not (np.isfinite(times).all() and (steps >= 0).all() and (steps == 0).any() and steps.any()):
        return ""
    unit = float(steps[steps > 0].min())
    away = np.abs(times - times[0] - np.arange(len(times)) / rate).max()
    return f"rounded to {unit:.2g} s" if away <= unit else ""
