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

    Below four visible frames the order is lower: a parabola through three, a line through two, a
    constant at one. Outside the visible frames the nearest visible value holds. A channel with
    none takes its mean over the recordings given to `fit`. There is no predictive distribution.

    Attributes
    ----------
    channels_ : tuple of D str
        The channels of the recordings given to `fit`.
    mean_ : ndarray of shape (D,)
        Mean of each channel's visible entries, NaN without any.

    References
    ----------
    Wang, Fleet and Hertzmann (2008), Gaussian process dynamical models for human motion, Table 2,
    column "Spline".
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
            If channels differ, or one is hidden in a whole recording and in all given to `fit`.
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
                f"recording {recording.name!r}: channels {channels} have no visible entry here nor "
                "in the recordings given to fit; show one or drop them"
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
