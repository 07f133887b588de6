"""A recording: channels over time, some entries of which may be hidden."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from mmap import mmap
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mocapbench.basics.numbers import real_numbers

__all__ = ["FrameByChannel", "Frames", "Mask", "Recording"]

Frames = NDArray[np.float64]
"""(N,) one value per frame."""
FrameByChannel = NDArray[np.float64]
"""(N, D) one row per frame, one column per channel."""
Mask = NDArray[np.bool_]
"""(N, D) True or False for each entry of a recording."""


def _freeze(numbers: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return numbers on immutable bytes, which no model can make writeable again."""
    if numbers.flags.c_contiguous and _is_frozen(numbers):
        return numbers  # of another recording, which may be large
    return np.frombuffer(numbers.tobytes(), dtype=np.float64).reshape(numbers.shape)


def _is_frozen(numbers: NDArray[np.float64]) -> bool:
    """Return whether an array is on immutable bytes, or on a file that can only be read.

    Unpickled ones are on bytes, but writeable.
    """
    base: object = numbers
    while isinstance(base, np.ndarray):
        base = base.base
    try:
        numbers.view().setflags(write=True)
    except ValueError:
        return isinstance(base, bytes | mmap) and memoryview(base).readonly
    return False


@dataclass(frozen=True, eq=False)
class Recording:
    """A multivariate time series that cannot be changed.

    Parameters
    ----------
    name : str
        Identifies the recording within a problem; an `Archive` uses the address.
    times : array_like of shape (N,)
        Strictly increasing times in seconds.
    values : array_like of shape (N, D)
        One column per channel, in the channel's unit; NaN marks a hidden entry.
    channels : sequence of D str
        Names such as ``lfemur.rx``, all different.
    units : sequence of D str
        Unit of each channel: ``"deg"`` for angles of the Acclaim format, ``""`` for its root
        translations, which are in the skeleton's own unit of length; free text otherwise.

    Raises
    ------
    ValueError
        If shapes disagree, times are not finite and strictly increasing, an entry is infinite or
        not a real number, channel names repeat, the name is not a string, or channels or units are
        not a sequence of strings.

    See Also
    --------
    Archive.recording : Reads one by its address.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.datasets import Recording
    >>> walk = Recording(
    ...     name="walk",
    ...     times=[0.0, 0.1, 0.2],
    ...     values=[[10.0, 1.0], [20.0, 2.0], [30.0, 3.0]],
    ...     channels=["knee.rx", "hip.rx"],
    ...     units=["deg", "deg"],
    ... )
    >>> walk.select(["hip.rx"]).values.ravel()
    array([1., 2., 3.])
    >>> walk.frames([0, 2]).times
    array([0. , 0.2])
    >>> gap = walk.hide(np.array([[False, False], [True, True], [False, False]]))
    >>> gap.values
    array([[10.,  1.],
           [nan, nan],
           [30.,  3.]])
    >>> gap.visible[1]
    array([False, False])
    """

    name: str
    times: Frames
    values: FrameByChannel
    channels: tuple[str, ...]
    units: tuple[str, ...]

    def __post_init__(self) -> None:
        if not isinstance(self.name, str):
            raise ValueError(f"expected the name of a recording to be a string, got {self.name!r}")
        for field, value in (
            ("times", self._numbers("times", self.times)),
            ("values", self._numbers("values", self.values)),
            ("channels", self._names("channels", self.channels)),
            ("units", self._names("units", self.units)),
        ):
            object.__setattr__(self, field, value)
        self._validate()

    def _numbers(self, field: str, values: ArrayLike) -> NDArray[np.float64]:
        return _freeze(real_numbers(f"{field} of recording {self.name!r}", values))

    def _names(self, field: str, names: str | Sequence[str]) -> tuple[str, ...]:
        # A single string would be taken as one name per letter.
        if isinstance(names, Iterable) and not isinstance(names, str):
            listed = tuple(names)
            if all(isinstance(name, str) for name in listed):
                return listed
        raise ValueError(
            f"recording {self.name!r}: expected {field} to be a sequence of one string per "
            f"channel, got {'the string ' if isinstance(names, str) else ''}{names!r}"
        )

    def _validate(self) -> None:
        if self.times.ndim != 1:
            raise ValueError(
                f"recording {self.name!r}: expected times of shape (N,), one a frame, "
                f"got shape {self.times.shape}"
            )
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
        self._validate_times()
        if np.isinf(self.values).any():
            raise ValueError(
                f"recording {self.name!r}: expected finite values or NaN, got infinity"
            )

    def _validate_times(self) -> None:
        if not np.isfinite(self.times).all():
            raise ValueError(
                f"recording {self.name!r}: expected finite, strictly increasing times, "
                "got NaN or infinity; leave those frames out"
            )
        falls = np.flatnonzero(np.diff(self.times) <= 0)
        if falls.size:
            before, after = self.times[falls[0]], self.times[falls[0] + 1]
            raise ValueError(
                f"recording {self.name!r}: expected finite, strictly increasing times, got "
                f"{after} after {before}; sort the frames, and leave out those that repeat a time"
            )

    def __reduce__(self) -> tuple[type[Recording], tuple[object, ...]]:
        """Have copies made by the constructor, so that they cannot be changed either."""
        return Recording, (self.name, self.times, self.values, self.channels, self.units)

    @property
    def visible(self) -> Mask:
        """(N, D) True where an entry is known."""
        return ~np.isnan(self.values)

    def with_values(self, values: ArrayLike) -> Recording:
        """Return a recording with the same frames and channels and other values, (N, D)."""
        return replace(self, values=np.asarray(values, dtype=np.float64))

    def hide(self, hidden: ArrayLike) -> Recording:
        """Return the recording with entries NaN where ``hidden`` is True; itself if all are.

        Parameters
        ----------
        hidden : array_like of bool, shape (N, D), (N, 1) or (1, D)
            An axis of length 1 stands for all frames or all channels.

        Raises
        ------
        ValueError
            If ``hidden`` is not boolean, or of another shape.
        """
        mask, shape = np.asarray(hidden), self.values.shape
        fits = mask.ndim == 2 and all(n in (1, m) for n, m in zip(mask.shape, shape, strict=True))
        if mask.dtype != np.bool_ or not fits:
            raise ValueError(
                f"recording {self.name!r}: expected True or False for each entry to hide, of shape "
                f"{shape} (times, channels), got {mask.dtype} of shape {mask.shape}"
            )
        hides = (mask & self.visible).any()
        return self.with_values(np.where(mask, np.nan, self.values)) if hides else self

    def select(self, channels: Sequence[str]) -> Recording:
        """Return the named channels, in the order given.

        Raises
        ------
        ValueError
            If ``channels`` is one string, or a channel is not in the recording.
        """
        names = self._names("channels", channels)
        missing = [name for name in names if name not in self.channels]
        if missing:
            raise ValueError(f"recording {self.name!r} has no channels {missing}")
        if names == self.channels:
            return self
        columns = [self.channels.index(name) for name in names]
        return replace(
            self,
            values=self.values[:, columns],
            channels=names,
            units=tuple(self.units[column] for column in columns),
        )

    def frames(self, index: ArrayLike) -> Recording:
        """Return the frames of a list of 0-based indices; they keep their times.

        A mask (N,) of True or False stands for the indices at which it is True.

        Raises
        ------
        ValueError
            If ``index`` is neither, an index is out of range, or indices do not increase.
        """
        rows = self._rows(np.asarray(index))
        return replace(self, times=self.times[rows], values=self.values[rows])

    def _rows(self, index: NDArray[Any]) -> NDArray[np.intp]:
        n_frames = len(self.times)
        if index.dtype == np.bool_ and index.shape == (n_frames,):
            return np.flatnonzero(index)
        if index.dtype.kind in "iuf" and index.ndim == 1:  # Rounded numbers may be floats.
            with np.errstate(invalid="ignore"):
                rows = index.astype(np.intp)
            if ((rows == index) & (-n_frames <= rows) & (rows < n_frames)).all():
                return rows
        raise ValueError(
            f"recording {self.name!r}: expected a list of indices of its {n_frames} frames, or "
            f"True or False for each, got {index.dtype} of shape {index.shape}: {index!r}"
        )
