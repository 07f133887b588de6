"""The alignment of recordings with one common cycle, as part of a solution."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from mocapbench.benchmark.problems.arrays import Arrays, with_numbers
from mocapbench.benchmark.problems.base import InvalidPredictionError
from mocapbench.datasets import Recording

if TYPE_CHECKING:
    from mocapbench.baselines import Aligner

__all__ = ["alignment_of"]


def alignment_of(model: Aligner, recordings: Sequence[Recording]) -> Arrays:
    """Return the state of the common cycle that each frame of the training recordings is in.

    They are ``path-k`` (N_k,) of recording k, with states 0 … M − 1, and ``cycle_length``, which
    is M.

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
    return {"cycle_length": np.array(model.cycle_length_), **with_numbers("path", paths)}
