"""A recording: channels over time, with hidden entries."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["FrameByChannel", "Frames", "Mask", "Recording"]

Frames = NDArray[np.float64]
"""(N,) one value a frame."""
FrameByChannel = NDArray[np.float64]
"""(N, D) one row a frame, one column a channel."""
Mask = NDArray[np.bool_]
"""(N, D) truth values over the entries of a recording."""


def _frozen(array: ArrayLike) -> NDArray[np.float64]:
    """Return a copy that stands on immutable bytes, so that no model can unlock it."""
    copy = np.asarray(array, dtype=np.float64)
    return np.frombuffer(copy.tobytes(), dtype=np.float64).reshape(copy.shape)


@dataclass(frozen=True, eq=False)
class Recording:
    """An immutable multivariate time series.

    Parameters
    ----------
    name : str
        Identifies the recording within a problem.
    times : array_like of shape (N,)
        Strictly increasing times in seconds.
    values : array_like of shape (N, D)
        One column per channel, in the channel's unit; NaN marks a hidden entry.
    channels : sequence of D str
        Names such as ``lfemur.rx``, all different.
    units : sequence of D str
        ``"deg"``, ``"cm"`` or ``""`` per channel.

    Raises
    ------
    ValueError
        If shapes disagree, a time is not finite or not increasing, an entry is infinite, or
        channel names repeat.
    """

    name: str
    times: Frames
    values: FrameByChannel
    channels: tuple[str, ...]
    units: tuple[str, ...]

    def __post_init__(self) -> None:
        for field, value in (
            ("times", _frozen(self.times)),
            ("values", _frozen(self.values)),
            ("channels", tuple(self.channels)),
            ("units", tuple(self.units)),
        ):
            object.__setattr__(self, field, value)
        self._validate()

    def _validate(self) -> None:
        expected = (len(self.times), len(self.channels))
        if self.values.shape != expected:
            raise ValueError(
                f"recording {self.name!r}: expected values of shape {expected} "
                f"(times, channels), got {self.values.shape}"
            )
        if len(self.units) != len(self.channels) or len(set(self.channels)) != len(self.channels):
            raise ValueError(
                f"recording {self.name!r}: expected distinct channel names and one unit for each, "
                f"got {len(self.channels)} names ({len(set(self.channels))} distinct) "
                f"and {len(self.units)} units"
            )
        if not (np.isfinite(self.times).all() and (np.diff(self.times) > 0).all()):
            raise ValueError(f"recording {self.name!r}: expected finite, strictly increasing times")
        if np.isinf(self.values).any():
            raise ValueError(
                f"recording {self.name!r}: expected finite values or NaN, got infinity"
            )

    @property
    def visible(self) -> Mask:
        """(N, D) True where an entry is known."""
        return ~np.isnan(self.values)

    def with_values(self, values: ArrayLike) -> Recording:
        """Return the same frames and channels with other values, of shape (N, D)."""
        return replace(self, values=np.asarray(values, dtype=np.float64))

    def hide(self, hidden: ArrayLike) -> Recording:
        """Return a copy whose entries are NaN where ``hidden`` (N, D) is True."""
        return self.with_values(np.where(np.asarray(hidden, dtype=bool), np.nan, self.values))

    def select(self, channels: Sequence[str]) -> Recording:
        """Return the named channels, in the order given.

        Raises
        ------
        ValueError
            If a channel is not in the recording.
        """
        missing = [name for name in channels if name not in self.channels]
        if missing:
            raise ValueError(f"recording {self.name!r} has no channels {missing}")
        columns = [self.channels.index(name) for name in channels]
        return replace(
            self,
            values=self.values[:, columns],
            channels=tuple(channels),
            units=tuple(self.units[column] for column in columns),
        )

    def frames(self, index: ArrayLike) -> Recording:
        """Return the frames that ``index`` (0-based integers) names, at their own times."""
        rows = np.asarray(index, dtype=np.intp)
        return replace(self, times=self.times[rows], values=self.values[rows])
