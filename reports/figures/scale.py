"""Scales: from values to places on the page, with ticks at round values, chosen to fit."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mocapbench.basics.arrays import Array

__all__ = [
    "CountScale",
    "LinearScale",
    "LogScale",
    "Scale",
    "fit_count_scale",
    "fit_linear_scale",
    "fit_scale",
    "remark",
]

_ROUND = (1.0, 2.0, 5.0, 10.0)
_LOG_TICKS = (((1, 2, 5), 1), ((1, 3), 1), *(((1,), every) for every in (1, 2, 3, 5, 10, 20, 50)))
"""Leading digits of logarithmic ticks, and at every how many powers of ten, the finest first."""


_MOST = 1e250
"""In size: of larger values, margins and powers of ten are beyond all numbers."""
LOG_RANGE = 10.0
"""Ratio of the largest to the smallest value above which an axis is logarithmic."""
NARROW = 0.05
"""Share of its values below which the span of an axis deserves a remark."""
MARGIN = 0.04
"""Share of an axis that stays free beyond the outermost values."""


@dataclass(frozen=True)
class Scale(ABC):
    """A monotone map from values to places.

    Parameters
    ----------
    low, high : float
        The values at the two ends, in ascending order.
    start, stop : float
        Where the ends are, in pixels.
    """

    about_means: ClassVar[str]
    """What the caption says of the means on it."""

    low: float
    high: float
    start: float
    stop: float

    @staticmethod
    @abstractmethod
    def forward(values: Array) -> Array:
        """Return what the scale is linear in."""

    @staticmethod
    @abstractmethod
    def backward(values: Array) -> Array:
        """Return the inverse of `forward`."""

    @abstractmethod
    def ticks(self, most: int = 5) -> list[float]:
        """Return round values within the ends, about ``most`` at most, in ascending order."""

    def places(self, values: Array) -> Array:
        """Return the place of each value, in pixels; NaN stays NaN."""
        low, high = self.forward(np.array([self.low, self.high]))
        share = (self.forward(values) - low) / (high - low)
        return np.asarray(self.start + share * (self.stop - self.start))

    def place(self, value: float) -> float:
        """Return the place of one value, in pixels."""
        return float(self.places(np.array([value]))[0])


class LinearScale(Scale):
    """Equal differences take equal lengths."""

    about_means: ClassVar[str] = ""

    @staticmethod
    def forward(values: Array) -> Array:  # noqa: D102
        return values

    @staticmethod
    def backward(values: Array) -> Array:  # noqa: D102
        return values

    def ticks(self, most: int = 5) -> list[float]:  # noqa: D102
        step = _round_step((self.high - self.low) / most)
        first, last = math.ceil(self.low / step - 1e-9), math.floor(self.high / step + 1e-9)
        return [float(f"{place * step:.12g}") for place in range(first, last + 1)]


class LogScale(Scale):
    """Equal ratios take equal lengths; all values are positive."""

    about_means: ClassVar[str] = "On a logarithmic axis points are geometric means over folds."

    @staticmethod
    def forward(values: Array) -> Array:  # noqa: D102
        return np.asarray(np.log10(values))

    @staticmethod
    def backward(values: Array) -> Array:  # noqa: D102
        return np.asarray(10.0**values)

    def ticks(self, most: int = 5) -> list[float]:  # noqa: D102
        tried = (self._within(digits, every) for digits, every in _LOG_TICKS)
        ticks = next((ticks for ticks in tried if 3 <= len(ticks) <= most + 1), None)
        return ticks or LinearScale(self.low, self.high, self.start, self.stop).ticks(most)

    def _within(self, digits: Sequence[int], every: int) -> list[float]:
        """Return the multiples of powers of ten within the ends, at every so many powers."""
        first, last = math.floor(math.log10(self.low)), math.ceil(math.log10(self.high))
        powers = (power for power in range(first, last + 1) if power % every == 0)
        ticks = (float(f"{digit}e{power}") for power in powers for digit in digits)
        return [tick for tick in ticks if self.low <= tick <= self.high]


class CountScale(Scale):
    """Equal ratios take about equal lengths, and zero is on it too."""

    about_means: ClassVar[str] = ""

    @staticmethod
    def forward(values: Array) -> Array:  # noqa: D102
        return np.asarray(np.log1p(values))

    @staticmethod
    def backward(values: Array) -> Array:  # noqa: D102
        return np.asarray(np.expm1(values))

    def ticks(self, most: int = 5) -> list[float]:  # noqa: D102
        powers = range(math.ceil(math.log10(max(self.high, 1.0))))
        ticks = {digit * 10.0**power for power in powers for digit in (1, 3, 10)}
        return [0.0, *sorted(tick for tick in ticks if tick <= self.high)[-most:]]


def _round_step(least: float) -> float:
    """Return the smallest of 1, 2, 5, 10 … times a power of ten that is at least ``least``."""
    power = 10.0 ** math.floor(math.log10(least))
    return next(m * power for m in _ROUND if m * power >= least * (1.0 - 1e-9))


def fit_scale(values: Iterable[float], start: float, stop: float) -> Scale:
    """Return the scale that shows ``values``, logarithmic where they span more than a factor 10.

    Parameters
    ----------
    values : iterable of float
        Those that are not finite are passed over.
    start, stop : float
        Where the ends are, in pixels.
    """
    low, high = _range(values)
    kind = LogScale if low > 1.0 / _MOST and high > LOG_RANGE * low else LinearScale
    return _around(kind, low, high, start, stop)


def fit_count_scale(values: Iterable[float], start: float, stop: float) -> Scale:
    """Return the scale that shows counts from zero, logarithmic but for that; see `fit_scale`."""
    return _around(CountScale, *_range(values), start, stop)


def fit_linear_scale(values: Iterable[float], start: float, stop: float) -> Scale:
    """Return the linear scale that shows ``values``; see `fit_scale`."""
    return _around(LinearScale, *_range(values), start, stop)


def _range(values: Iterable[float]) -> tuple[float, float]:
    finite = [value for value in values if math.isfinite(value)] or [0.0, 1.0]
    return max(min(finite), -_MOST), min(max(finite), _MOST)


def _around(kind: type[Scale], low: float, high: float, start: float, stop: float) -> Scale:
    ends = kind.forward(np.array([low, high]))
    margin = MARGIN * float(ends[1] - ends[0]) or 0.05 * abs(low) or 1.0
    low, high = map(float, kind.backward(ends + np.array([-margin, margin])))
    return kind(low, high, start, stop)


def remark(scale: Scale) -> str:
    """Return a sentence on an axis that spans little of its values; empty on any other."""
    largest = max(abs(scale.low), abs(scale.high))
    share = (scale.high - scale.low) / largest
    return f"The axis spans {100.0 * share:.1g} % of the values." if share < NARROW else ""
