"""Matched training recordings, with Gaussian-process regression of the residuals on pose.

A new subject differs from the training subjects, but by similar amounts whenever the pose is
similar. Every training recording is therefore matched with the new one by its cheapest path
(`PoseViterbi`), and the paths are averaged. A Gaussian process over the matched pose and time then
predicts the residuals at hidden frames from those at visible frames (kriging). Where left and right
take turns, as in a walk, mirror images of recordings are matched too, and what is seen of one side
tells about the other. How far the paths lie apart says how sure the average is. In short gaps, what
the recording's own course over time tells is surer: both are weighed by their variances. A motion
that no path explains is filled from its own course alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import cycle
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_channels, check_recordings
from mocapbench.baselines.common.heading import face_ahead, face_as_before
from mocapbench.baselines.common.pose_units import from_pose_units, in_pose_units
from mocapbench.baselines.common.recordings import by_content, visible_frames, with_steps
from mocapbench.baselines.common.validation import (
    check_not_negative,
    check_positive,
    check_share,
)
from mocapbench.baselines.kriging.conditioned import copy_gaps, growth_of_variance
from mocapbench.baselines.kriging.frame_rates import keep_thirty_frames, restore_frames
from mocapbench.baselines.kriging.mirror_images import (
    Image,
    MirroredResiduals,
    find_symmetries,
    images_of,
)
from mocapbench.baselines.kriging.own_course import own_course
from mocapbench.baselines.kriging.paths import (
    blend_paths,
    doubt_about_path,
    explained_share,
    match_paths,
    weigh_paths,
)
from mocapbench.baselines.kriging.stances import find_reference, find_stance
from mocapbench.baselines.pose_viterbi import PoseViterbi
from mocapbench.baselines.protocols import FrameImputer, Inductive, Prediction
from mocapbench.basics.arrays import Array, Index
from mocapbench.datasets import FrameByChannel, Recording
from mocapbench.datasets.formats.angle_wrapping import mean_directions, wrapping_offsets

__all__ = ["PoseKriging"]


_LEAST_VARIANCE = 1e-12
"""Least scale of a channel's residual, as a fraction of the total variance in training."""
_ALIKE = 0.5
"""Correlation of errors along paths with those of the own course: .3 to .8, more in the middle of
long gaps, in recordings from which `in-betweening` learns."""


class PoseKriging(FrameImputer, Inductive):
    r"""Fill frames from matched training recordings, corrected by a Gaussian process.

    Training recording k contributes the poses :math:`m_k(t)` of its cheapest path, the subject's
    offset from it taken out: first the difference of means, then the mean residual of a rough path,
    twice. Recordings that match far worse than the best one are left out. The poses are averaged to
    :math:`m(t)` with weights :math:`w_k \propto \exp(-3 e_k / \min_j e_j)`, where :math:`e_k` is
    the variance of the residual at visible frames; in the mean of a fill, weights move to those
    that explain visible frames best (``mocapbench.baselines.kriging.paths``). The conditional mean
    of a Gaussian process then corrects it: each channel of :math:`y - m` is a constant, about which
    nothing is known before, plus a process of covariance :math:`\sigma_d^2 (e^{-|t - t'| / \tau} +
    v\, e^{-\|m(t) - m(t')\|^2 / 2 h^2 S} + 0.05\, \delta)`, with S the total variance of training
    frames, each recording's about its mean. A constant that is added to a channel in the middle of
    the body, or multiples of 360° added to any angle, are therefore added to the fill, and
    change nothing else.

    If the training motion looks like its own mirror image, the mirror image of each recording is a
    further one, and the residuals of a mirrored recording count as further observations at the
    mirrored poses. The part that depends on pose correlates between a channel and its mirror image
    by ``symmetry``, and so do the constants of two channels that change sides; a constant that they
    have in common is free, half their difference has the variance :math:`10 (1 - \text{symmetry})`.

    The predictive variance is that of this process, with the scale :math:`\sigma_d^2` integrated
    out, and grown by how much more than expected it errs in visible stretches as long as the gaps,
    each left out, plus the doubt about the path. Each path, corrected in the same way, is a
    prediction :math:`\mu_k(t)`, and :math:`\mu(t)` their mean with weights w. A new subject counts
    as one more draw from those whose paths are seen, so that with :math:`q = \sum_k w_k^2` the
    doubt is :math:`\frac{1 + q}{1 - q} \sum_k w_k (\mu_k(t) - \mu(t))^2`. A single training
    recording says nothing about it.

    Of the rotation and the path of a root such as the Acclaim format has, the mean heading of each
    recording is taken out (``mocapbench.baselines.common.heading``), and of markers where they
    stand and face on the whole (``mocapbench.baselines.kriging.stances``): a motion is filled alike
    wherever it stands and faces.

    The recording's own course over time (``mocapbench.baselines.kriging.own_course``) is a second
    prediction. With the total variances a and b of a frame along paths and by the own course, and
    the correlation :math:`\rho = 1/2` of their errors, :math:`(b - \rho \sqrt{ab}) / (a + b - 2
    \rho \sqrt{ab})`, from 0 to 1, is the weight of the first in the mean that errs least; the
    variance is that of a mixture with these weights.

    A recording is unlike its training if no path explains the share ``least_explained`` of its
    variance at visible frames. It is filled from its own course over time, whatever was learnt, and
    so is one that was the only one to learn from.

    The defaults gave nearly the least error when each training walker of ``missing-frames`` was
    held out in turn; ``docs/results/people.md`` says what each part earns over thirty people. Time
    is counted in frames, of which 30 per second are used
    (``mocapbench.baselines.kriging.frame_rates``). Where channels have several units, degrees and
    radians count as degrees, and mm, cm and m as the CMU database's unit of length, 5.64 cm.

    Parameters
    ----------
    smoothness : float, default=10.0
        The weight λ of jumps in `PoseViterbi`; positive.
    steps : int, default=4
        The number of states of a training frame in `PoseViterbi`; at least 1.
    pose_lengthscale : float, default=1.0
        The lengthscale h over poses, in units of the total standard deviation √S; positive.
    pose_variance : float, default=6.0
        The prior variance v of the part that depends on pose; not negative.
    time_lengthscale : float, default=4.0
        The lengthscale τ over time, in frames; positive.
    symmetry : float, default=0.8
        The correlation of a residual with that of the mirror image in the same pose, from 0 to 1.
    least_explained : float, default=1/3
        The least share of a recording's variance that its best path explains, between 0 and 1. With
        0, a path must be better than a pose that never changes.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    reference_ : ndarray of shape (M, 3)
        The mean shape of markers that all recordings are turned to; (0, 3) without markers.
    directions_ : ndarray of shape (D,)
        The circular mean of each angle in training; 0 for channels that are no angles.
    symmetries_ : tuple of Image
        The motion itself, and its mirror image where training looks like it.
    names_ : tuple of str
        The names of the training recordings with two consecutive complete frames.
    matchers_ : list of PoseViterbi
        One for each symmetry and each of these, in the units in which they are compared. A
        recording that is filled is not matched with itself.
    total_variance_ : float
        The sum S of the channels' variances in training, each recording's and its image's about
        their means, in the units in which they are compared.

    References
    ----------
    Not from a publication. The Gaussian-process regression is that of C. E. Rasmussen and C. K. I.
    Williams (2006), Gaussian Processes for Machine Learning, MIT Press, eq. (2.41) and (2.42); the
    task is that of J. M. Wang, D. J. Fleet and A. Hertzmann (2008), Gaussian Process Dynamical
    Models for Human Motion, IEEE TPAMI 30(2), Table 2.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import PoseKriging
    >>> from mocapbench.datasets import Recording
    >>> times = np.arange(30) / 30
    >>> angle = 2 * np.pi * np.arange(30) / 15
    >>> values = np.column_stack([np.sin(angle), np.cos(angle)])
    >>> walk = Recording("walk", times, values, ("hip", "knee"), ("deg",) * 2)
    >>> shifted = Recording("new", times, values + 0.3, ("hip", "knee"), ("deg",) * 2)
    >>> gap = np.repeat(((times > 0.3) & (times < 0.5))[:, None], 2, axis=1)
    >>> (prediction,) = PoseKriging().fit([walk]).impute([shifted.hide(gap)])
    >>> bool(np.abs(prediction.mean - shifted.values).max() < 0.5)
    True
    """

    family: ClassVar[str] = "Alignment"
    provides: ClassVar[frozenset[str]] = (
        FrameImputer.provides
        | Inductive.provides
        | {"turns along", "moves along", "mirrors along", "scales along", "resamples along"}
    )

    max_frames: ClassVar[int | None] = 500

    def __init__(
        self,
        smoothness: float = 10.0,
        *,
        steps: int = 4,
        pose_lengthscale: float = 1.0,
        pose_variance: float = 6.0,
        time_lengthscale: float = 4.0,
        symmetry: float = 0.8,
        least_explained: float = 1.0 / 3.0,
    ) -> None:
        self.smoothness = smoothness
        self.steps = steps
        self.pose_lengthscale = pose_lengthscale
        self.pose_variance = pose_variance
        self.time_lengthscale = time_lengthscale
        self.symmetry = symmetry
        self.least_explained = least_explained

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Keep the complete frames of each recording.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, a name
            repeats, or no two consecutive frames are complete.
        """
        for name in ("pose_lengthscale", "time_lengthscale"):
            check_positive(name, getattr(self, name))
        check_not_negative("pose_variance", self.pose_variance)
        check_share("symmetry", self.symmetry)
        check_share("least_explained", self.least_explained)
        checked = by_content(check_recordings(recordings))
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        self.reference_: Array = find_reference(checked[0])
        slow = [keep_thirty_frames(each)[0] for each in checked]
        stood = [find_stance(each, self.reference_).take_out(each) for each in slow]
        ahead = [face_ahead(recording)[0] for recording in stood]
        self.directions_: Array = mean_directions(ahead)
        usable = [in_pose_units(self._wrap_angles(one)) for one in with_steps(ahead)]
        self.names_: tuple[str, ...] = tuple(recording.name for recording in usable)
        self.symmetries_: tuple[Image, ...] = find_symmetries(usable)
        self.matchers_: list[PoseViterbi] = [
            PoseViterbi(self.smoothness, steps=self.steps).fit([image.of_recording(recording)])
            for image in self.symmetries_
            for recording in usable
        ]
        # Where each training body faces says nothing of how much a motion moves.
        frames = np.concatenate(
            [each.frames_ - each.frames_.mean(axis=0) for each in self.matchers_]
        )
        self.total_variance_: float = float(frames.var(axis=0).sum()) or 1.0
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the mean and variance of hidden frames.

        Raises
        ------
        ValueError
            If channels differ, a frame is hidden in part, or no frame is visible.
        """
        check_is_fitted(self)
        check_channels(recordings, self.channels_, self.units_)
        return [self._fill_recording(recording) for recording in recordings]

    def _wrap_angles(self, recording: Recording) -> Recording:
        away = wrapping_offsets(recording, self.directions_)
        return recording.with_values(recording.values - away)

    def _fill_recording(self, recording: Recording) -> Prediction:
        visible_frames(recording)  # refuses frames that are hidden in part
        slow, kept = keep_thirty_frames(recording)
        return restore_frames(recording, self._predict(slow), kept)

    def _predict(self, recording: Recording) -> Prediction:
        stance = find_stance(recording, self.reference_)
        stood = stance.take_out(recording)
        ahead, heading = face_ahead(stood)
        away = wrapping_offsets(ahead, self.directions_)
        near = ahead.with_values(ahead.values - away)
        found = from_pose_units(near, *self._fill_frames(in_pose_units(near)))
        faced = face_as_before(stood, found.mean + away, found.variance, heading)
        return stance.put_back(recording, faced.mean, faced.variance)

    def _fill_frames(self, recording: Recording) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the mean and variance (N, D) of all frames given the visible ones."""
        others = self._matchers_of_others(recording.name)
        if not others:
            return self._own_course(recording)
        paths, errors = match_paths(recording, others)
        total = recording.values[visible_frames(recording)].var(axis=0).sum()
        if explained_share(errors, float(total)) < self.least_explained:
            return self._own_course(recording)
        along_paths = self._correct_paths(recording, paths, weigh_paths(errors))
        return _unite(along_paths, self._own_course(recording))

    def _correct_paths(
        self, recording: Recording, paths: Array, weights: Array
    ) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the mean and variance (N, D) of the paths, corrected by their residuals."""
        visible, n_frames = visible_frames(recording), len(recording.times)
        n_images, unexplained = len(self.symmetries_), recording.values - paths
        seen = np.tile(visible, n_images)
        residuals = np.array([images_of(each, self.symmetries_)[seen] for each in unexplained])
        corrected, variance = paths.copy(), np.empty(recording.values.shape)
        copies = [_in_all_images(each, visible, n_images) for each in copy_gaps(visible)]
        sums, matched = np.empty((2, len(self.channels_))), np.tensordot(weights, paths, axes=1)
        products = np.zeros((len(paths), len(paths)))
        for channels, given in self._residuals().condition(matched, visible):
            those = residuals[:, :, channels]
            corrected[:, :, channels] += [given.mean(each)[:n_frames] for each in those]
            averaged = np.tensordot(weights, those, axes=1)
            scales = given.scales(averaged, self._least(visible))
            variance[:, channels] = given.variances(scales)[:n_frames]
            sums[:, channels] = given.leave_out(copies, averaged, scales)
            products += given.products(those, scales) / n_images  # each image has every residual
        mean = np.tensordot(blend_paths(weights, products), corrected, axes=1)
        variance *= growth_of_variance(sums)
        return mean, variance + doubt_about_path(corrected, weights)

    def _residuals(self) -> MirroredResiduals:
        return MirroredResiduals(
            self.symmetries_,
            self.pose_lengthscale**2 * self.total_variance_,
            self.pose_variance,
            self.time_lengthscale,
            self.symmetry,
        )

    def _own_course(self, recording: Recording) -> tuple[FrameByChannel, FrameByChannel]:
        visible = visible_frames(recording)
        return own_course(recording.values, visible, self._least(visible))

    def _least(self, visible: NDArray[np.bool_]) -> float:
        """Return the least scale of a channel."""
        # One frame tells nothing of how far channels go: no further than in all of training.
        return (_LEAST_VARIANCE if visible.sum() > 1 else 1.0) * self.total_variance_

    def _matchers_of_others(self, name: str) -> list[PoseViterbi]:
        """Leave out the recording to fill: its path through itself would seem free of error."""
        pairs = zip(cycle(self.names_), self.matchers_, strict=False)
        return [matcher for other, matcher in pairs if other != name]


def _in_all_images(frames: Index, visible: NDArray[np.bool_], n_images: int) -> Index:
    """Return the numbers of visible frames, and those of them in all images of the recording."""
    return np.concatenate([frames + image * visible.sum() for image in range(n_images)])


def _unite(
    one: tuple[FrameByChannel, FrameByChannel], other: tuple[FrameByChannel, FrameByChannel]
) -> tuple[FrameByChannel, FrameByChannel]:
    """Return the mean and variance (N, D) of two predictions of which one holds.

    In each frame it is the first with the probability with which the weighted mean errs least.
    """
    (mean, variance), (mean_there, variance_there) = one, other
    doubt, doubt_there = (np.sqrt(each.sum(axis=1)) for each in (variance, variance_there))
    shared = _ALIKE * doubt * doubt_there
    gain = (doubt_there**2 - shared) / (doubt**2 + doubt_there**2 - 2.0 * shared)
    weight = np.clip(gain, 0.0, 1.0)[:, None]
    spread = weight * (1.0 - weight) * (mean - mean_there) ** 2
    both = weight * variance + (1.0 - weight) * variance_there
    return weight * mean + (1.0 - weight) * mean_there, both + spread
