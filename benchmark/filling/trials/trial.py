"""A trial: a question whose answer is known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.filling.gaps import Episode
from mocapbench.benchmark.filling.question import GapQuestion

__all__ = ["Trial"]


@dataclass(frozen=True, eq=False)
class Trial:
    """A question whose answer is known.

    Parameters
    ----------
    question : GapQuestion
        The recording, or a part of it that begins or ends with a gap, with more hidden.
    truth : ndarray of shape (M,)
        The values of the wanted entries, in the order of ``np.nonzero(question.target)``.
    units : tuple of ndarray of int
        The places among them (M,) of the entries of each trial gap, which are scored together.
    copies : tuple of Episode
        The trial gaps, at their frames in the whole recording.
    originals : tuple of Episode
        The real gaps of which these are copies.
    share : float
        The length of the shortest trial gap relative to the real one; 1 if none was shortened.
    """

    question: GapQuestion
    truth: NDArray[np.float64]
    units: tuple[NDArray[np.intp], ...]
    copies: tuple[Episode, ...]
    originals: tuple[Episode, ...]
    share: float
