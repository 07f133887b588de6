"""The cheapest path through the training frames, shifted by the subject's mean difference.

Every frame of a recording is matched with a training frame: visible frames with a similar one, and
consecutive frames with ones that follow each other. Dynamic programming (Viterbi) finds the path
that costs least. Subjects differ mainly by a constant in each channel, so that the mean residual at
the visible frames is added to the whole path.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from sklearn.metrics.pairwise import euclidean_distances
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_channels, check_recordings
from mocapbench.baselines.common.pose_units import in_pose_units, pose_factors
from mocapbench.baselines.common.recordings import by_content, complete_stretches, visible_frames
from mocapbench.baselines.common.shortest_path import cheapest_path, cheapest_path_among
from mocapbench.baselines.common.validation import check_count, check_positive, check_share
from mocapbench.baselines.protocols import FrameImputer, Inductive, Prediction
from mocapbench.basics.arrays import Array, Index
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["PoseViterbi"]

_SEARCHED = 1200
"""States that are all searched: those of ten seconds at 30 frames per second and four a frame.

Each time costs their square. For recordings from which `in-betweening` learns, frames alone and
then what is near took a quarter of the time, and filled as well.
"""


class PoseViterbi(FrameImputer, Inductive):
    r"""Fill frames from the cheapest path through the training frames.

    The cost of a path :math:`s_1 \ldots s_T` is :math:`\sum_{t\ \text{visible}}
    \|y_t - Y_{s_t}\|^2 + \lambda \sum_t \|Y_{s_t + u} - Y_{s_{t+1}}\|^2`, where every frame counts
    as u states, interpolated by a cubic spline. Going on to the next training frame is free; a jump
    costs the squared difference between the frame that would follow and the frame jumped to. With
    several states a frame, a motion a little slower or faster than training costs little. No jump
    leaves the last frame of a stretch. Of more than 1200 states, a path through frames alone is
    searched first, and then the cheapest within a frame of where that is, was last or will be next.
    Time is counted in frames, so that all recordings should have the same frame rate. Where
    channels have several units, degrees and radians count as degrees, and mm, cm and m as the CMU
    database's unit of length, 5.64 cm. There is no predictive distribution.

    Parameters
    ----------
    smoothness : float, default=10.0
        The weight λ of jumps; positive.
    subject_offset : float, default=1.0
        The fraction, from 0 to 1, of the mean residual at the visible frames that is added to the
        fill: 1 shifts the training poses to the new subject's mean, 0 leaves them unchanged.
    steps : int, default=1
        The number u of states of a training frame; at least 1.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    frames_ : ndarray of shape (S, D)
        The complete training frames, and the states between them, in the units in which costs are
        measured.
    first_, last_ : ndarray of int, shape (S,)
        The first and the last state of the stretch that a state is in.
    whole_ : ndarray of int, shape (F,)
        The states that are training frames.
    searched_ : ndarray of int, shape (M,)
        The states among which a path is searched first: all, or the frames alone.

    References
    ----------
    Not from a publication. The dynamic programme is that of G. D. Forney (1973), The Viterbi
    Algorithm, Proceedings of the IEEE 61(3). The task is that of J. M. Wang, D. J. Fleet and
    A. Hertzmann (2008), Gaussian Process Dynamical Models for Human Motion, IEEE TPAMI 30(2),
    Table 2.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import PoseViterbi
    >>> from mocapbench.datasets import Recording
    >>> times = np.arange(30) / 30
    >>> angle = 2 * np.pi * np.arange(30) / 15
    >>> values = np.column_stack([np.sin(angle), np.cos(angle)])
    >>> walk = Recording("walk", times, values, ("hip", "knee"), ("deg",) * 2)
    >>> shifted = Recording("new", times, values + 0.3, ("hip", "knee"), ("deg",) * 2)
    >>> gap = np.repeat(((times > 0.3) & (times < 0.5))[:, None], 2, axis=1)
    >>> (prediction,) = PoseViterbi().fit([walk]).impute([shifted.hide(gap)])
    >>> bool(np.abs(prediction.mean - shifted.values).max() < 0.5)
    True
    """

    family: ClassVar[str] = "Alignment"
    provides: ClassVar[frozenset[str]] = (
        FrameImputer.provides | Inductive.provides | {"scales along"}
    )

    max_frames: ClassVar[int | None] = 1000

    def __init__(
        self, smoothness: float = 10.0, subject_offset: float = 1.0, *, steps: int = 1
    ) -> None:
        self.smoothness = smoothness
        self.subject_offset = subject_offset
        self.steps = steps

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Keep the complete frames of the recordings, and the costs of jumps between them.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, a name
            repeats, or no two consecutive frames are complete.
        """
        check_positive("smoothness", self.smoothness)
        check_share("subject_offset", self.subject_offset)
        check_count("steps", self.steps, 1)
        checked = by_content(check_recordings(recordings))
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        moved = [in_pose_units(recording) for recording in checked]
        stretches = [_refine_stretch(each, self.steps) for each in complete_stretches(moved)]
        self.frames_: FrameByChannel = np.concatenate(stretches)
        lengths = [len(each) for each in stretches]
        last = np.cumsum(lengths) - 1
        self.first_: Index = np.repeat(last + 1 - lengths, lengths)
        self.last_: Index = np.repeat(last, lengths)
        places = np.arange(len(self.frames_)) - self.first_
        self.whole_: Index = np.flatnonzero(places % self.steps == 0)
        few = len(places) <= _SEARCHED
        self.searched_: Index = np.arange(len(places)) if few else self.whole_
        for computed in ("transition_", "_transition_of_whole"):
            vars(self).pop(computed, None)  # of an earlier fit
        return self

    @cached_property
    def transition_(self) -> Array:
        """The cost (M, M) of going from a searched state (row) to another (column).

        It is infinite where that is not allowed. It is computed for the first search, so that a
        model that was only fitted is handed to other processes without: of a hundred recordings it
        takes gigabytes.
        """
        return self._cost_jumps(self.searched_, self.searched_)

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the frames of the cheapest path, shifted by the subject's offset.

        Raises
        ------
        ValueError
            If channels differ, a frame is hidden in part, or no frame is visible.
        """
        check_is_fitted(self)
        check_channels(recordings, self.channels_, self.units_)
        return [
            Prediction.around(recording, self._fill_recording(recording))
            for recording in recordings
        ]

    def residual(self, recording: Recording) -> NDArray[np.float64]:
        """Return the mean residual (D,) of the cheapest path, in the channels' units.

        The mean is over the visible frames.

        Raises
        ------
        ValueError
            If a frame is hidden in part, or no frame is visible.
        """
        return _mean_residual(recording, self.match(recording))

    def _fill_recording(self, recording: Recording) -> FrameByChannel:
        match = self.match(recording)
        return match + self.subject_offset * _mean_residual(recording, match)

    def match(self, recording: Recording) -> FrameByChannel:
        """Return the training frames (N, D) of the cheapest path, in the channels' units.

        Raises
        ------
        ValueError
            If a frame is hidden in part, or no frame is visible.
        """
        return self._match_among(recording, self.searched_, self.transition_)

    def match_roughly(self, recording: Recording) -> FrameByChannel:
        """Return the training frames (N, D) of the cheapest path near that of frames alone.

        It takes about the time of `match` by the square of ``steps``, and is the same where `match`
        searches frames alone first.

        Raises
        ------
        ValueError
            If a frame is hidden in part, or no frame is visible.
        """
        return self._match_among(recording, self.whole_, self._transition_of_whole)

    @cached_property
    def _transition_of_whole(self) -> Array:
        """The cost of going from a state that is a training frame to another: `transition_`."""
        if len(self.whole_) == len(self.searched_):
            return self.transition_
        return self._cost_jumps(self.whole_, self.whole_)

    def _match_among(
        self, recording: Recording, searched: Index, transition: Array
    ) -> FrameByChannel:
        """Return the cheapest path among some states, and from there near it."""
        visible = visible_frames(recording)
        values = in_pose_units(recording).values[visible]
        # Hidden frames cost nothing, so that jumps alone decide there.
        costs = np.zeros((len(visible), len(searched)))
        costs[visible] = euclidean_distances(values, self.frames_[searched], squared=True)
        path = searched[cheapest_path(costs, transition)]
        if len(searched) < len(self.frames_):
            path = self._search_near(path, values, visible)
        return np.asarray(self.frames_[path] / pose_factors(recording.units))

    def _search_near(self, path: Index, values: Array, visible: NDArray[np.bool_]) -> Index:
        """Return the cheapest path (T,) near another one, given the values of visible frames."""
        states = self._states_near(path)
        costs = np.zeros(states.shape)
        costs[visible] = ((values[:, None] - self.frames_[states[visible]]) ** 2).sum(axis=2)
        chosen = cheapest_path_among(costs, self._cost_jumps(states[:-1], states[1:]))
        return np.asarray(states[np.arange(len(states)), chosen])

    def _states_near(self, path: Index) -> Index:
        """Return the states (T, W) within a frame of where a path is, was last or will be next."""
        times = np.arange(len(path))[:, None] + np.arange(-1, 2)
        there = path[np.clip(times, 0, len(path) - 1)][:, :, None]
        beside = there + np.arange(-self.steps, self.steps + 1)
        states: Index = np.clip(beside, self.first_[there], self.last_[there])
        return states.reshape(len(path), -1)

    def _cost_jumps(self, here: Index, there: Index) -> Array:
        """Return λ ‖Y_{s+u} − Y_{s'}‖² from states s (…, m) to s' (…, n); infinite at an end."""
        last = self.last_[here]
        after, onto = self.frames_[np.minimum(here + self.steps, last)], self.frames_[there]
        # ‖a − b‖² = ‖a‖² − 2 aᵀb + ‖b‖², the states that lead to one beside each other: so they are
        # searched. In place, since there may be gigabytes.
        leading = onto @ np.swapaxes(-2.0 * after, -1, -2)
        leading += (after**2).sum(axis=-1)[..., None, :]
        leading += (onto**2).sum(axis=-1)[..., None]
        np.maximum(leading, 0.0, out=leading)
        leading *= self.smoothness
        costs = np.swapaxes(leading, -1, -2)
        costs[here + self.steps > last] = np.inf
        return np.asarray(costs)


def _mean_residual(recording: Recording, match: FrameByChannel) -> NDArray[np.float64]:
    return np.asarray(np.nanmean(recording.values - match, axis=0))


def _refine_stretch(stretch: FrameByChannel, steps: int) -> FrameByChannel:
    """Return a stretch with ``steps`` states a frame, by a cubic spline through its frames."""
    if steps == 1 or len(stretch) == 1:
        return stretch
    places = np.arange((len(stretch) - 1) * steps + 1) / steps
    return np.asarray(CubicSpline(np.arange(len(stretch)), stretch)(places))
