"""Which rows of a file are missing: frames that it skips, as its count of frames or times show."""

from __future__ import annotations

import warnings
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from mocapbench.datasets.formats.errors import FormatWarning
from mocapbench.datasets.recording import Frames

__all__ = ["count_missing_rows", "counts_frames", "most_common_step", "warn_of_missing_rows"]

_JUMP, _SPREADS = 1.7, 3.0
"""From how many usual steps on a row is missing, and from how many spreads above one."""
_SHORT, _SHORTEST = 0.1, 0.5
"""The share of steps by which times spread below the usual one, and where these tell nothing."""
_HUGE = 1e15  # counts beyond are no whole numbers of a double


def count_missing_rows(
    n_rows: int, frames: Frames | None, times: Frames | None
) -> NDArray[np.intp]:
    """Return how many rows are missing behind each of N rows but the last, (N − 1,).

    A count of frames says it, or else times that rise, by steps that are far longer than the usual
    one. How far is told by the shortest steps, as no missing row makes a step short.
    """
    none = np.zeros(max(n_rows - 1, 0), dtype=np.intp)
    if frames is not None and counts_frames(frames):
        return _count_within(np.diff(frames) / most_common_step(frames))
    steps = none if times is None else np.diff(times)
    if not len(steps) or not (np.isfinite(steps) & (steps > 0)).all():
        return none
    in_usual = steps / np.median(steps)
    short = float(np.quantile(in_usual, _SHORT))
    if short < _SHORTEST:
        return none
    jump = max(_JUMP, 1.0 + _SPREADS * (1.0 - short))
    return _count_within(np.where(in_usual >= jump, in_usual, 1.0))


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
