"""K-means on the first cycle of each recording, without alignment."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.alignment.cycle_start import cycle_length
from mocapbench.baselines.common.checks import check_recordings, check_visible
from mocapbench.baselines.common.cycle_settings import check_settings
from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.baselines.common.prototypes import group_rows
from mocapbench.baselines.common.recordings import interpolate_channels, visible_moments
from mocapbench.baselines.protocols import Clusterer
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["KMeans"]


class KMeans(Clusterer):
    r"""Cluster recordings by the raw values of their first cycle (K-means).

    The length of a cycle is estimated for each recording by its autocorrelation; a recording
    without a recurrence counts as one cycle. The cycle is resampled to a fixed number of frames by
    linear interpolation, which also fills hidden entries. All channels together, in their own
    units, form one point. Recordings start at arbitrary phases and are not aligned, so that the
    difference between this model and one that aligns measures the benefit of alignment.

    Parameters
    ----------
    n_styles : int, default=4
        Number of clusters; the number of recordings, if that is smaller.
    n_frames : int, default=32
        Number of frames that a cycle is resampled to.
    n_restarts : int, default=10
        Number of starts of K-means; the clustering with the least sum of squares is kept.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the starts.

    Attributes
    ----------
    labels_ : ndarray of int, shape (K,)
        The cluster of each recording.
    cycles_ : ndarray of shape (K, n_frames, D)
        The resampled cycles.

    Notes
    -----
    With the resampled cycle :math:`P_k` of recording k, K-means chooses clusters c and their means
    C:

    .. math:: \min_{c, C} \sum_k \| P_k - C_{c(k)} \|^2

    References
    ----------
    S. P. Lloyd (1982), Least Squares Quantization in PCM, IEEE Transactions on Information Theory
    28(2), as implemented by scikit-learn.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import KMeans
    >>> from mocapbench.datasets import Recording
    >>> phase = 2 * np.pi * np.arange(40) / 10
    >>> walks = [
    ...     Recording(name, np.arange(40) / 10, size * np.sin(phase)[:, None], ("knee",), ("deg",))
    ...     for name, size in [("a", 1.0), ("b", 1.1), ("c", 5.0)]
    ... ]
    >>> labels = KMeans(n_styles=2, random_state=0).fit(walks).labels_
    >>> bool(labels[0] == labels[1]), bool(labels[0] == labels[2])
    (True, False)
    """

    family: ClassVar[str] = "Neighbours"

    def __init__(
        self,
        n_styles: int = 4,
        *,
        n_frames: int = 32,
        n_restarts: int = 10,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_styles = n_styles
        self.n_frames = n_frames
        self.n_restarts = n_restarts
        self.random_state = random_state

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Resample the cycles and cluster them.

        Raises
        ------
        ValueError
            If a parameter is of the wrong type or out of range, there is no recording, channels
            differ, a name repeats, or a channel is hidden in all recordings.
        """
        check_settings(self.get_params())
        checked = check_recordings(recordings)
        check_visible(checked)
        mean, _ = visible_moments(checked)
        self.cycles_: Array = np.stack([_cycle(each, self.n_frames, mean) for each in checked])
        points = self.cycles_.reshape(len(checked), -1)
        rng = np.random.default_rng(self.random_state)
        self.labels_: NDArray[np.intp] = group_rows(points, self.n_styles, self.n_restarts, rng)
        return self


def _cycle(recording: Recording, n_frames: int, mean: Array) -> FrameByChannel:
    """Return the first cycle at ``n_frames`` frames; a wholly hidden channel takes its mean."""
    period = cycle_length(Sequences.of([recording.values]))
    frames = np.arange(len(recording.times), dtype=np.float64)
    places = period * np.arange(n_frames) / n_frames
    cycle = interpolate_channels(recording.values, frames, places)
    return np.where(np.isnan(cycle), mean, cycle)
