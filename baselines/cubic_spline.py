"""Cubic splines through the visible frames, channel by channel."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import numpy as np
from scipy.interpolate import CubicSpline
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.recordings import check_channels, check_recordings, visible_moments
from mocapbench.baselines.protocols import Imputer, Inductive, Prediction
from mocapbench.datasets import FrameByChannel, Frames, Recording

__all__ = ["CubicSplineImputer"]


class CubicSplineImputer(Imputer, Inductive):
    """Interpolate each channel with a not-a-knot cubic spline over time.

    With fewer than four visible frames the order is lower: a parabola through three, a line
    through two, a constant at one. Before the first and after the last visible frame the nearest
    visible value is held. A channel without a visible frame takes its mean over the recordings
    given to `fit`. There is no predictive distribution.

    Attributes
    ----------
    channels_ : tuple of D str
        The channels of the recordings given to `fit`.
    mean_ : ndarray of shape (D,)
        Mean of each channel's visible entries; NaN if it has none.

    References
    ----------
    C. de Boor (2001), A Practical Guide to Splines, revised edition, Springer, chapter IV.

    J. M. Wang, D. J. Fleet and A. Hertzmann (2008), Gaussian Process Dynamical Models for Human
    Motion, IEEE TPAMI 30(2),
    Table 2, column "Spline".

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import CubicSplineImputer
    >>> from mocapbench.datasets import Recording
    >>> times = np.arange(8.0)
    >>> cubic = Recording("cubic", times, times[:, None] ** 3, ("x",), ("cm",))
    >>> hidden = np.isin(times, [3.0, 4.0])[:, None]
    >>> (prediction,) = CubicSplineImputer().fit([cubic]).impute([cubic.hide(hidden)])
    >>> np.round(prediction.mean[3:5, 0], 6)
    array([27., 64.])
    """

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Learn the channels' means.

        Raises
        ------
        ValueError
            If there is no recording, channels differ, or a name repeats.
        """
        checked = check_recordings(recordings)
        self.channels_ = checked[0].channels
        self.mean_, _ = visible_moments(checked)
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the splines at the hidden entries.

        Raises
        ------
        ValueError
            If channels differ, or a channel has no visible entry in a recording and none in those
            given to `fit`.
        """
        check_is_fitted(self)
        check_channels(recordings, self.channels_)
        return [Prediction.around(recording, self._curves(recording)) for recording in recordings]

    def _curves(self, recording: Recording) -> FrameByChannel:
        means = zip(recording.values.T, self.mean_, strict=True)
        curves = np.column_stack([_curve(recording.times, *channel) for channel in means])
        if np.isnan(curves).any():
            channels = [recording.channels[d] for d in np.flatnonzero(np.isnan(curves).any(axis=0))]
            raise ValueError(
                f"recording {recording.name!r}: expected a visible entry of every channel here or "
                f"in the recordings given to fit, got none of {channels}; leave these channels out"
            )
        return curves


def _curve(times: Frames, values: Frames, mean: float) -> Frames:
    """Return the curve of one channel (N,) at all times; ``mean`` where nothing is visible."""
    seen = ~np.isnan(values)
    if seen.sum() < 2:
        return np.full(len(times), values[seen][0] if seen.any() else mean)
    knots = times[seen]
    # With three or two knots, SciPy's not-a-knot condition is the parabola or the line.
    spline = CubicSpline(knots, values[seen], bc_type="not-a-knot")
    return np.asarray(spline(np.clip(times, knots[0], knots[-1])))
