"""Nearest neighbours: of frames for partly hidden frames, of transitions for wholly hidden ones."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from sklearn.impute import KNNImputer
from sklearn.neighbors import NearestNeighbors
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_channels, check_recordings, check_visible, pool
from mocapbench.baselines.common.pose_units import from_pose_units, in_pose_units
from mocapbench.baselines.common.recordings import (
    by_content,
    hidden_frames,
    places_by_content,
    stack,
    visible_moments,
    with_steps,
)
from mocapbench.baselines.common.transitions import Steps, fill_gap
from mocapbench.baselines.common.validation import check_count
from mocapbench.baselines.protocols import Imputer, Inductive, Prediction
from mocapbench.basics.arrays import Array
from mocapbench.basics.mask_runs import runs
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["KNN"]


TIE = 1e-6
"""By how much of the spread of times recordings that are equally far in time differ."""


class KNN(Imputer, Inductive):
    r"""Fill hidden entries from the nearest frames of all recordings.

    If every frame of a recording is either visible or hidden as a whole, a transition model fills
    each gap: the path from one end of the gap to the other whose steps are nearest, in least
    squares, to the mean steps of the training frames near it
    (``mocapbench.baselines.common.transitions``). Any other recording is filled by scikit-learn's
    ``KNNImputer`` on the stacked frames of all recordings. Time is one more column, scaled to the
    median standard deviation of the channels. Where frames are equally near, in time alone, their
    order and what their recordings contain decide. Where channels have several units, degrees and
    radians count as degrees, and mm, cm and m as the CMU database's unit of length, 5.64 cm.

    Both use the recordings given to `fit` and the visible entries of the recording to fill. There
    is no predictive distribution.

    Parameters
    ----------
    n_neighbors : int, default=15
        Number of neighbours that are averaged; all frames, if there are fewer.

    Attributes
    ----------
    recordings_ : tuple of Recording
        The recordings given to `fit`.

    Notes
    -----
    With N(x) the nearest training frames of a frame x, a gap is filled by the path with given ends
    that minimises

    .. math::

        \sum_t \| y_{t+1} - y_t - m(y_t) \|^2, \qquad
        m(y) = \frac{1}{|N(y)|} \sum_{i \in N(y)} (Y_{i+1} - Y_i)

    by turns with the steps m held fixed. Single entries take the mean of that channel over the
    nearest frames in which it is visible.

    References
    ----------
    O. Troyanskaya et al. (2001), Missing Value Estimation Methods for DNA Microarrays,
    Bioinformatics 17(6): the method of ``KNNImputer``.

    J. M. Wang, D. J. Fleet and A. Hertzmann (2008), Gaussian Process Dynamical Models for Human
    Motion, IEEE TPAMI 30(2),
    Table 2, column "KNN-15": the paper does not state its objective, and this model does not
    reproduce the column.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import KNN
    >>> from mocapbench.datasets import Recording
    >>> times = np.arange(6.0)
    >>> values = np.column_stack([times, 2 * times])
    >>> line = Recording("line", times, values, ("x", "y"), ("cm", "cm"))
    >>> gap = np.isin(times, [2.0, 3.0])[:, None] & np.array([True, True])
    >>> (prediction,) = KNN(n_neighbors=1).fit([line]).impute([line.hide(gap)])
    >>> np.round(prediction.mean[2:4], 6)
    array([[2., 4.],
           [3., 6.]])
    """

    family: ClassVar[str] = "Neighbours"
    provides: ClassVar[frozenset[str]] = Imputer.provides | Inductive.provides | {"scales along"}

    max_frames: ClassVar[int | None] = 2000

    def __init__(self, n_neighbors: int = 15) -> None:
        self.n_neighbors = n_neighbors

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Keep the recordings.

        Raises
        ------
        ValueError
            If ``n_neighbors`` is not an integer of at least 1, there is no recording, channels
            differ, or a name repeats.
        """
        check_count("n_neighbors", self.n_neighbors, 1)
        self.recordings_: tuple[Recording, ...] = by_content(check_recordings(recordings))
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return each recording filled, independently of the others given here.

        Raises
        ------
        ValueError
            If channels differ, a channel is visible nowhere, a recording is hidden as a whole, or
            no two consecutive frames are visible from which to learn a transition.
        """
        check_is_fitted(self)
        check_channels(recordings, self.recordings_[0].channels, self.recordings_[0].units)
        return [
            from_pose_units(recording, self._fill_recording(recording)) for recording in recordings
        ]

    def _fill_recording(self, recording: Recording) -> FrameByChannel:
        pooled = [in_pose_units(each) for each in pool(self.recordings_, [recording])]
        recording = in_pose_units(recording)
        complete = recording.visible.all(axis=1)
        whole = complete == recording.visible.any(axis=1)
        fill = _fill_frames if whole.all() and not complete.all() else _fill_entries
        return fill(recording, pooled, self.n_neighbors)


def _fill_entries(
    recording: Recording, pooled: Sequence[Recording], n_neighbors: int
) -> FrameByChannel:
    """Return the recording filled by scikit-learn: nearest over entries visible in both frames."""
    check_visible(pooled)
    _, variance = visible_moments(pooled)
    times = np.concatenate([other.times for other in pooled])
    # Time is one more coordinate, that varies as the channel of median spread does.
    spread = times.std() or 1.0
    scale = np.median(np.sqrt(variance)) / spread
    imputer = KNNImputer(n_neighbors=n_neighbors)
    imputer.fit(np.column_stack([stack(pooled), scale * (times + _later(pooled, spread))]))
    frames = np.column_stack([recording.values, scale * recording.times])
    return np.asarray(imputer.transform(frames)[:, :-1])


def _later(recordings: Sequence[Recording], spread: float) -> Array:
    """Return how much later (n_frames,) each frame counts, so that no two are equally far in time.

    Otherwise rounding, which differs among processors, would choose between those before and after
    a frame, and among recordings.
    """
    ranks = 1 + places_by_content(recordings)
    return np.repeat(TIE * spread * ranks, [len(recording.times) for recording in recordings])


def _fill_frames(
    recording: Recording, pooled: Sequence[Recording], n_neighbors: int
) -> FrameByChannel:
    """Return the recording with each gap filled by the transition model."""
    filled = recording.values.copy()
    steps = _mean_steps(pooled, n_neighbors)
    for gap in runs(hidden_frames(recording)):
        path = np.arange(max(gap[0] - 1, 0), min(gap[-1] + 2, len(filled)))
        if len(path) == len(gap):
            raise ValueError(f"recording {recording.name!r}: expected a visible frame, got none")
        filled[path] = fill_gap(recording.values[path], steps)
    return filled


def _mean_steps(recordings: Sequence[Recording], n_neighbors: int) -> Steps:
    """Return a function from frames to the mean step of the training frames nearest to each."""
    usable = with_steps(recordings)
    steps = np.concatenate([np.diff(recording.values, axis=0) for recording in usable])
    frames = np.concatenate([recording.values[:-1] for recording in usable])
    known = ~np.isnan(steps).any(axis=1)
    steps, frames = steps[known], frames[known]
    index = NearestNeighbors(n_neighbors=min(n_neighbors, len(frames))).fit(frames)

    def mean_steps(places: FrameByChannel) -> Array:
        neighbours = index.kneighbors(places, return_distance=False)
        return np.asarray(steps[neighbours].mean(axis=1))

    return mean_steps
