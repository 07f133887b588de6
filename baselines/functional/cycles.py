"""Recordings cut into cycles, where their phase passes a whole number."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.functional.statistics import CurveStatistics
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Recording

__all__ = ["Cycles"]


@dataclass(frozen=True, eq=False)
class Cycles:
    """The J cycles of some recordings, one recording after the other.

    Parameters
    ----------
    phases : tuple of ndarray, each of shape (N_j,)
        Of the frames of each cycle.
    owners : ndarray of int, shape (J,)
        The index of the recording that each is from.
    statistics : CurveStatistics
        What their visible entries tell about coefficients.
    """

    phases: tuple[Array, ...]
    owners: NDArray[np.intp]
    statistics: CurveStatistics

    @classmethod
    def of(cls, recordings: Sequence[Recording], phases: Sequence[Array], n_harmonics: int) -> Self:
        """Cut recordings whose frames have the given rising ``phases``, each (N_k,)."""
        breaks = [np.flatnonzero(np.diff(np.floor(path))) + 1 for path in phases]
        curves = [
            curve
            for recording, path, at in zip(recordings, phases, breaks, strict=True)
            for curve in zip(np.split(path, at), np.split(recording.values, at), strict=True)
        ]
        return cls(
            tuple(path for path, _ in curves),
            np.repeat(np.arange(len(recordings)), [len(at) + 1 for at in breaks]),
            CurveStatistics.of(curves, n_harmonics),
        )
