"""Training recordings as the family takes them: complete stretches of the channels that move."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from sklearn.utils.extmath import svd_flip

from mocapbench.baselines.common.gaps import complete_stretches
from mocapbench.baselines.common.recordings import check_recordings
from mocapbench.datasets import Recording

__all__ = ["Sequences", "whitened_components"]

Array = NDArray[np.float64]

_CONSTANT = 1e-9
"""A channel whose range is below this share of its size does not move."""


@dataclass(frozen=True, eq=False)
class Sequences:
    """Stretches of complete frames, one below the other.

    Parameters
    ----------
    mean : ndarray of shape (D,)
        Of all channels.
    moving : ndarray of bool, shape (D,)
        The channels that are not constant.
    y : ndarray of shape (N, D')
        The moving channels, their mean subtracted.
    lengths : tuple of int
    """

    mean: Array
    moving: NDArray[np.bool_]
    y: Array
    lengths: tuple[int, ...]

    @classmethod
    def of(cls, recordings: Sequence[Recording]) -> Sequences:
        """Return the complete stretches of recordings, which are taken in order of their names.

        Raises
        ------
        ValueError
            If there is no recording, channels differ, a name repeats, no two consecutive frames
            are complete, or no channel moves.
        """
        checked = sorted(check_recordings(recordings), key=lambda recording: recording.name)
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
            f"left out, and filled with their value: the channels {', '.join(channels)}, which "
            "are constant in training",
            stacklevel=4,
        )


def whitened_components(y: Array, n_latent: int) -> Array:
    """Return the first principal components of ``y`` (N, D) with variance one: (N, d).

    At most as many as ``y`` has rank; a warning says so where they are fewer than asked for.
    """
    left, singular, right = np.linalg.svd(y, full_matrices=False)
    left, _ = svd_flip(left, right)
    rank = int((singular > singular[0] * max(y.shape) * np.finfo(float).eps).sum())
    if rank < n_latent:
        warnings.warn(
            f"expected data of at least n_latent={n_latent} dimensions, got {rank}: "
            f"the latent space has {rank}",
            stacklevel=4,
        )
    return np.asarray(left[:, : min(rank, n_latent)] * np.sqrt(len(y)))
