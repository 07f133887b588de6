"""The cheapest path through the training frames, moved to where the new subject is.

Every frame of a recording is matched with a training frame, visible frames with one like them and
each frame with one that may follow its predecessor's; the path that does both best is a dynamic
programme. People of one kind move alike around poses of their own, so the mean of what the match
misses at the visible frames is added to the whole.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import numpy as np
from numpy.typing import NDArray
from sklearn.metrics.pairwise import euclidean_distances
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.gaps import complete_stretches, hidden_frames
from mocapbench.baselines.common.recordings import check_channels, check_recordings
from mocapbench.baselines.common.shortest_path import cheapest_path
from mocapbench.baselines.common.validation import check_positive, check_share
from mocapbench.baselines.protocols import FrameImputer, Inductive, Prediction
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["PoseViterbi"]


class PoseViterbi(FrameImputer, Inductive):
    r"""Fill frames from the cheapest path :math:`s_1 \ldots s_T` through the training frames.

    Its cost is :math:`\sum_{t\ \text{visible}} \|y_t - Y_{s_t}\|^2 + \lambda \sum_t
    \|Y_{s_t + 1} - Y_{s_{t+1}}\|^2`: to go on to the next frame of training is free, to jump
    costs as much as the pose changes. The last frame of a stretch has no next one. Frames are
    counted, not seconds, so that all recordings should have one frame rate. There is no
    predictive distribution.

    Parameters
    ----------
    smoothness : float, default=10.0
        The weight λ of jumps; positive.
    subject_offset : float, default=1.0
        The share of the mean residual at the visible frames that is added to the fill: 1 moves
        the training poses to the new subject's, 0 leaves them.

    Attributes
    ----------
    channels_ : tuple of D str
        The channels of the recordings given to `fit`.
    frames_ : ndarray of shape (S, D)
        The complete training frames.
    transition_ : ndarray of shape (S, S)
        The cost of going from one to another.
    """

    def __init__(self, smoothness: float = 10.0, subject_offset: float = 1.0) -> None:
        self.smoothness = smoothness
        self.subject_offset = subject_offset

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Keep the complete frames of the recordings, and what it costs to jump between them.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, a name
            repeats, or no two consecutive frames are complete.
        """
        check_positive("smoothness", self.smoothness)
        check_share("subject_offset", self.subject_offset)
        checked = check_recordings(recordings)
        self.channels_ = checked[0].channels
        stretches = complete_stretches(checked)
        self.frames_ = np.concatenate(stretches)
        ends = np.cumsum([len(stretch) for stretch in stretches]) - 1
        self.transition_ = self.smoothness * _jumps(self.frames_, ends)
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the frames of the cheapest path, moved by the subject's offset.

        Raises
        ------
        ValueError
            If channels differ, a frame is hidden in part, or no frame is visible.
        """
        check_is_fitted(self)
        check_channels(recordings, self.channels_)
        return [Prediction.around(recording, self._filled(recording)) for recording in recordings]

    def residual(self, recording: Recording) -> NDArray[np.float64]:
        """Return the mean (D,) of what the cheapest path misses at the visible frames.

        Raises
        ------
        ValueError
            If a frame is hidden in part, or no frame is visible.
        """
        return _mean_residual(recording, self.match(recording))

    def _filled(self, recording: Recording) -> FrameByChannel:
        match = self.match(recording)
        return match + self.subject_offset * _mean_residual(recording, match)

    def match(self, recording: Recording) -> FrameByChannel:
        """Return the training frames (N, D) of the cheapest path.

        Raises
        ------
        ValueError
            If a frame is hidden in part, or no frame is visible.
        """
        visible = ~hidden_frames(recording)
        if not visible.any():
            raise ValueError(f"recording {recording.name!r}: expected a visible frame, got none")
        emission = np.zeros((len(visible), len(self.frames_)))
        known = recording.values[visible]
        emission[visible] = euclidean_distances(known, self.frames_, squared=True)
        return np.asarray(self.frames_[cheapest_path(emission, self.transition_)])


def _mean_residual(recording: Recording, match: FrameByChannel) -> NDArray[np.float64]:
    return np.asarray(np.nanmean(recording.values - match, axis=0))


def _jumps(frames: FrameByChannel, ends: NDArray[np.intp]) -> NDArray[np.float64]:
    """Return ‖Y_{s+1} − Y_{s'}‖² from frame s to s', infinite from the ends of stretches."""
    costs = np.full((len(frames), len(frames)), np.inf)
    going_on = np.setdiff1d(np.arange(len(frames)), ends)
    costs[going_on] = euclidean_distances(frames[going_on + 1], frames, squared=True)
    return costs
