"""Training recordings as the GPDM family takes them: complete stretches of moving channels."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.checks import check_recordings
from mocapbench.baselines.common.recordings import by_content, complete_stretches
from mocapbench.baselines.common.signs import orient_vectors
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Recording

__all__ = ["TrainingSequences", "whitened_components"]


_CONSTANT = 1e-9
"""A channel is constant if its range is at most this fraction of its largest absolute value."""


@dataclass(frozen=True, eq=False)
class TrainingSequences:
    """Stretches of complete frames, stacked.

    Parameters
    ----------
    mean : ndarray of shape (D,)
        Mean of every channel over all frames.
    moving : ndarray of bool, shape (D,)
        The channels that are not constant.
    y : ndarray of shape (N, D')
        The moving channels, their mean subtracted.
    lengths : tuple of int
        Frames of each stretch.
    """

    mean: Array
    moving: NDArray[np.bool_]
    y: Array
    lengths: tuple[int, ...]

    @classmethod
    def of(cls, recordings: Sequence[Recording]) -> TrainingSequences:
        """Return the complete stretches of the recordings, in the order `by_content`.

        Raises
        ------
        ValueError
            If there is no recording, channels differ, a name repeats, no two consecutive frames
            are complete, or no channel moves.
        """
        checked = by_content(check_recordings(recordings))
        stretches = complete_stretches(checked)
        values = np.concatenate(stretches)
        size = np.maximum(np.abs(values).max(axis=0), 1.0)
        moving = np.ptp(values, axis=0) > _CONSTANT * size
        _report_constant([checked[0].channels[d] for d in np.flatnonzero(~moving)], len(moving))
        mean = values.mean(axis=0)
        return cls(mean, moving, (values - mean)[:, moving], tuple(map(len, stretches)))


def _report_constant(channels: Sequence[str], n_channels: int) -> None:
    if len(channels) == n_channels:
        raise ValueError("expected a channel that moves in training, got none")
    if channels:
        warnings.warn(
            f"the channels {', '.join(channels)}, which are constant in training, are left out of "
            "the model and filled with their constant value",
            stacklevel=5,
        )


def whitened_components(y: Array, n_latent: int) -> Array:
    """Return the first principal components of ``y`` (N, D), scaled to variance 1: (N, d).

    Where the rank of ``y`` is below ``n_latent``, d is that rank, and a warning is issued.
    """
    left, singular, _ = np.linalg.svd(y, full_matrices=False)
    left = orient_vectors(left)
    # Components below rounding error, as in numpy.linalg.matrix_rank, are none.
    rank = int((singular > singular[0] * max(y.shape) * np.finfo(float).eps).sum())
    if rank < n_latent:
        warnings.warn(
            f"expected data of at least n_latent={n_latent} dimensions, got {rank}: "
            f"the latent space has {rank} dimensions",
            stacklevel=4,
        )
    return np.asarray(left[:, : min(rank, n_latent)] * np.sqrt(len(y)))
