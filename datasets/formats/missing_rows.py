"""Which rows of a file are missing: frames that it skips, as its count of frames or times show."""

from __future__ import annotations

import warnings
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.formats.errors import FormatWarning
from mocapbench.datasets.recording import Frames

__all__ = ["count_missing_rows", "counts_frames", "most_common_step", "warn_of_missing_rows"]

_REGULAR, _JUMP = 0.3, 1.7
"""Of the usual step: how far others are from multiples, and from which on a row is missing."""
_MOSTLY = 0.9
"""Of steps that are near a multiple: below, times are uneven, and tell of no missing row."""
_HUGE = 1e15  # counts beyond are no whole numbers of a double


def count_missing_rows(
    n_rows: int, frames: Frames | None, times: Frames | None
) -> NDArray[np.intp]:
    """Return how many rows are missing behind each of N rows but the last, (N − 1,).

    A count of frames says it, or else times that rise, if their steps are about multiples of the
    usual one.
    """
    none = np.zeros(max(n_rows - 1, 0), dtype=np.intp)
    if frames is not None and counts_frames(frames):
        return _count_within(np.diff(frames) / most_common_step(frames))
    steps = none if times is None else np.diff(times)
    if not len(steps) or not (np.isfinite(steps) & (steps > 0)).all():
        return none
    in_usual = steps / np.median(steps)
    regular = np.abs(in_usual - np.maximum(np.round(in_usual), 1.0)) <= _REGULAR
    if regular.mean() < _MOSTLY:
        return none
    return _count_within(np.where(in_usual >= _JUMP, in_usual, 1.0))


def warn_of_missing_rows(
    file: str, missing: NDArray[np.intp], where: Callable[[int], str], by: str, advice: str
) -> None:
    """Say how many rows are missing, and behind which.

    Parameters
    ----------
    file : str
    missing : ndarray of int of shape (N − 1,)
        As `count_missing_rows` returns it.
    where : callable
        From a row to what the message calls it, such as ``line 5``.
    by : str
        What shows it, such as the name of a column.
    advice : str
    """
    places = np.flatnonzero(missing)
    if len(places):
        n_rows, more = int(missing.sum()), f" and {len(places) - 1} later places"
        are = "row is" if n_rows == 1 else "rows are"
        more = more if len(places) > 2 else " and once later" if len(places) == 2 else ""
        warnings.warn(
            f"{file}: {n_rows} {are} missing, behind {where(int(places[0]))}{more}, by the steps "
            f"of {by}; {advice}",
            FormatWarning,
            stacklevel=2,
        )


def counts_frames(frames: Frames) -> bool:
    """Return whether they are whole numbers that rise."""
    known = np.isfinite(frames).all() and (np.abs(frames) < _HUGE).all()
    return bool(known and (np.diff(frames) > 0).all() and (frames == np.round(frames)).all())


def most_common_step(frames: Frames) -> float:
    """Return the step between most frames, of whole numbers that rise."""
    steps, counts = np.unique(np.diff(frames), return_counts=True)
    return float(steps[counts.argmax()]) if len(steps) else 1.0


def _count_within(steps: Frames) -> NDArray[np.intp]:
    """Return how many frames are missing within steps, in units of the usual one."""
    return np.minimum(np.round(steps) - 1.0, _HUGE).clip(0).astype(np.intp)
