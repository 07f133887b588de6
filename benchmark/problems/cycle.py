"""The alignment of recordings with one common cycle, as part of an answer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from mocapbench.baselines import Aligner, StatePath
from mocapbench.benchmark.problems.arrays import Arrays, arrays_by_number, with_numbers
from mocapbench.benchmark.problems.base import InvalidPredictionError
from mocapbench.datasets import Recording

__all__ = ["Alignment", "alignment_of"]


@dataclass(frozen=True, eq=False)
class Alignment:
    """The state of the common cycle that each frame of each recording is in.

    Parameters
    ----------
    cycle_length : int
        The number of states M.
    paths : tuple of ndarray of int, each of shape (N_k,)
        States 0 … M − 1.
    """

    cycle_length: int
    paths: tuple[StatePath, ...]

    def to_arrays(self) -> Arrays:
        """Return ``cycle_length`` and ``path-k`` of recording k."""
        return {"cycle_length": np.array(self.cycle_length), **with_numbers("path", self.paths)}

    @classmethod
    def from_arrays(cls, arrays: Arrays) -> Self | None:
        """Return the alignment that `to_arrays` turned into ``arrays``, None if there is none."""
        if "cycle_length" not in arrays:
            return None
        return cls(int(arrays["cycle_length"]), arrays_by_number("path", arrays))


def alignment_of(model: Aligner, recordings: Sequence[Recording]) -> Alignment:
    """Return the alignment of the recordings that ``model`` was fitted to.

    Raises
    ------
    InvalidPredictionError
        If a frame has no state, or one that is not on the cycle.
    """
    paths = tuple(np.asarray(path) for path in model.path_)
    lengths = [(len(recording.times),) for recording in recordings]
    if [path.shape for path in paths] != lengths:
        raise InvalidPredictionError(
            "path_: expected a state for each frame of each recording, "
            f"got paths of shapes {[path.shape for path in paths]}"
        )
    states = np.concatenate(paths)
    if not np.isin(states, np.arange(model.cycle_length_)).all():
        raise InvalidPredictionError(
            f"path_: expected states 0 to {model.cycle_length_ - 1}, "
            f"got {states.min()} to {states.max()}"
        )
    return Alignment(model.cycle_length_, paths)
