"""Interpolation over time, channel by channel: what practitioners fill gaps with first."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from scipy.interpolate import Akima1DInterpolator, CubicSpline, PchipInterpolator
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_channels, check_known, check_recordings
from mocapbench.baselines.common.recordings import visible_means
from mocapbench.baselines.protocols import Inductive, Interpolator, Prediction
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Frames, Recording

__all__ = [
    "CubicSplineImputer",
    "HoldImputer",
    "LinearImputer",
    "MakimaImputer",
    "PchipImputer",
]


class _Interpolation(Interpolator, Inductive):
    """What all interpolations share: each channel of each recording is filled by itself.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    mean_ : ndarray of shape (D,)
        Mean of each channel's visible entries; NaN if it has none.
    """

    provides: ClassVar[frozenset[str]] = (
        Interpolator.provides | Inductive.provides | {"mirrors along", "scales along"}
    )

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Learn the channels' means.

        Raises
        ------
        ValueError
            If there is no recording, channels differ, or a name repeats.
        """
        checked = check_recordings(recordings)
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        self.mean_: Array = visible_means(checked)
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the curves at the hidden entries.

        Raises
        ------
        ValueError
            If channels differ, or a channel has no visible entry in a recording and none in those
            given to `fit`.
        """
        check_is_fitted(self)
        check_channels(recordings, self.channels_, self.units_)
        return [Prediction(self._curves(recording)) for recording in recordings]

    def _curves(self, recording: Recording) -> FrameByChannel:
        curves = recording.values.copy()
        for channel, mean in zip(curves.T, self.mean_, strict=True):
            channel[np.isnan(channel)] = self._curve(recording.times, channel, mean)
        check_known(recording, np.asarray(~np.isnan(curves).any(axis=0)))
        return curves

    def _curve(self, times: Frames, values: Frames, mean: float) -> Frames:
        """Return the curve of one channel where it is hidden; ``mean`` if nothing is visible."""
        seen = ~np.isnan(values)
        if seen.sum() < 2:
            return np.full(np.count_nonzero(~seen), values[seen][0] if seen.any() else mean)
        knots = times[seen]
        return self._between(knots, values[seen], np.clip(times[~seen], knots[0], knots[-1]))

    @staticmethod
    @abstractmethod
    def _between(knots: Frames, values: Frames, times: Frames) -> Frames:
        """Return the curve through ``values`` at two or more ``knots``, at ``times`` among them."""


class HoldImputer(_Interpolation):
    r"""Hold each channel's last visible value until the next (last observation carried forward).

    Before the first visible frame its value is held backwards. A channel without a visible frame
    takes its mean over the recordings given to `fit`. There is no predictive distribution.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    mean_ : ndarray of shape (D,)
        Mean of each channel's visible entries; NaN if it has none.

    Notes
    -----
    .. math:: \hat y(t) = y\bigl(\max\{a \le t : a\ \text{visible}\}\bigr)

    References
    ----------
    R. J. A. Little and D. B. Rubin (2019), Statistical Analysis with Missing Data, third edition,
    Wiley, chapter 4.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import HoldImputer
    >>> from mocapbench.datasets import Recording
    >>> values = [[np.nan], [1.0], [np.nan], [5.0]]
    >>> recording = Recording("short", np.arange(4.0), values, ("x",), ("cm",))
    >>> HoldImputer().fit([recording]).impute([recording])[0].mean[:, 0]
    array([1., 1., 1., 5.])
    """

    provides: ClassVar[frozenset[str]] = _Interpolation.provides | {
        "moves along",
        "resamples along",
    }

    @staticmethod
    def _between(knots: Frames, values: Frames, times: Frames) -> Frames:
        return values[np.searchsorted(knots, times, side="right") - 1]


class LinearImputer(_Interpolation):
    r"""Interpolate each channel linearly over time.

    Before the first and after the last visible frame the nearest visible value is held. A channel
    without a visible frame takes its mean over the recordings given to `fit`. There is no
    predictive distribution.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    mean_ : ndarray of shape (D,)
        Mean of each channel's visible entries; NaN if it has none.

    Notes
    -----
    Between the visible frames a and b on either side of t:

    .. math:: \hat y(t) = y(a) + \frac{t - a}{b - a} \bigl(y(b) - y(a)\bigr)

    References
    ----------
    C. de Boor (2001), A Practical Guide to Splines, revised edition, Springer, chapter III.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import LinearImputer
    >>> from mocapbench.datasets import Recording
    >>> values = [[1.0], [np.nan], [5.0], [np.nan]]
    >>> recording = Recording("short", np.arange(4.0), values, ("x",), ("cm",))
    >>> LinearImputer().fit([recording]).impute([recording])[0].mean[:, 0]
    array([1., 3., 5., 5.])
    """

    provides: ClassVar[frozenset[str]] = _Interpolation.provides | {
        "moves along",
        "resamples along",
    }

    @staticmethod
    def _between(knots: Frames, values: Frames, times: Frames) -> Frames:
        return np.asarray(np.interp(times, knots, values))


class PchipImputer(_Interpolation):
    r"""Interpolate each channel with a piecewise cubic that never overshoots.

    The curve is monotone wherever the visible values are (PCHIP); through two visible frames it is
    a line. Before the first and after the last visible frame the nearest visible value is held. A
    channel without a visible frame takes its mean over the recordings given to `fit`. There is no
    predictive distribution.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    mean_ : ndarray of shape (D,)
        Mean of each channel's visible entries; NaN if it has none.

    Notes
    -----
    With :math:`h_i` the time from visible frame i to the next, and :math:`\delta_i` the slope of
    the line between them, the slope of the curve at i is 0 where :math:`\delta_{i-1}` and
    :math:`\delta_i` differ in sign or one is 0, and otherwise

    .. math::

        \frac{w_1 + w_2}{w_1 / \delta_{i-1} + w_2 / \delta_i}, \qquad
        w_1 = 2 h_i + h_{i-1}, \quad w_2 = h_i + 2 h_{i-1}

    References
    ----------
    F. N. Fritsch and J. Butland (1984), A Method for Constructing Local Monotone Piecewise Cubic
    Interpolants, SIAM Journal on Scientific and Statistical Computing 5(2): the slopes of
    ``scipy.interpolate.PchipInterpolator``.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import PchipImputer
    >>> from mocapbench.datasets import Recording
    >>> values = [[0.0], [0.0], [np.nan], [1.0], [1.0]]
    >>> recording = Recording("step", np.arange(5.0), values, ("x",), ("cm",))
    >>> PchipImputer().fit([recording]).impute([recording])[0].mean[:, 0]
    array([0. , 0. , 0.5, 1. , 1. ])
    """

    @staticmethod
    def _between(knots: Frames, values: Frames, times: Frames) -> Frames:
        with np.errstate(over="ignore"):  # the reciprocal of a slope near 0, whose curve is flat
            return np.asarray(PchipInterpolator(knots, values)(times))


class MakimaImputer(_Interpolation):
    r"""Interpolate each channel with a modified Akima piecewise cubic (makima).

    The slope at a visible frame is a weighted mean of those beside it, in which the flatter side
    counts more: the curve overshoots less than a cubic spline and bends more than PCHIP. Through
    two visible frames it is a line. Before the first and after the last visible frame the nearest
    visible value is held. A channel without a visible frame takes its mean over the recordings
    given to `fit`. There is no predictive distribution.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    mean_ : ndarray of shape (D,)
        Mean of each channel's visible entries; NaN if it has none.

    Notes
    -----
    With :math:`\delta_i` the slope of the line from visible frame i to the next, the slope of the
    curve at i is

    .. math::

        \frac{w_1 \delta_{i-1} + w_2 \delta_i}{w_1 + w_2}, \qquad
        w_1 = |\delta_{i+1} - \delta_i| + \tfrac12 |\delta_{i+1} + \delta_i|, \quad
        w_2 = |\delta_{i-1} - \delta_{i-2}| + \tfrac12 |\delta_{i-1} + \delta_{i-2}|

    References
    ----------
    H. Akima (1970), A New Method of Interpolation and Smooth Curve Fitting Based on Local
    Procedures, Journal of the ACM 17(4).

    C. Moler and C. Ionita (2019), Makima Piecewise Cubic Interpolation, MathWorks: the weights of
    ``scipy.interpolate.Akima1DInterpolator`` with ``method="makima"``.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import MakimaImputer
    >>> from mocapbench.datasets import Recording
    >>> values = [[0.0], [1.0], [np.nan], [3.0], [4.0]]
    >>> recording = Recording("line", np.arange(5.0), values, ("x",), ("cm",))
    >>> MakimaImputer().fit([recording]).impute([recording])[0].mean[:, 0]
    array([0., 1., 2., 3., 4.])
    """

    @staticmethod
    def _between(knots: Frames, values: Frames, times: Frames) -> Frames:
        if len(knots) < 3:  # older versions of SciPy leave the slopes at two knots undefined
            return LinearImputer._between(knots, values, times)
        return np.asarray(Akima1DInterpolator(knots, values, method="makima")(times))


class CubicSplineImputer(_Interpolation):
    r"""Interpolate each channel with a not-a-knot cubic spline over time.

    With fewer than four visible frames the order is lower: a parabola through three, a line
    through two, a constant at one. Before the first and after the last visible frame the nearest
    visible value is held. A channel without a visible frame takes its mean over the recordings
    given to `fit`. There is no predictive distribution.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    mean_ : ndarray of shape (D,)
        Mean of each channel's visible entries; NaN if it has none.

    Notes
    -----
    The cubic pieces s between visible frames :math:`t_1 \ldots t_n` join with equal values and two
    equal derivatives. Not-a-knot means that the third one is equal, too, at the second and the last
    but one:

    .. math:: s(t_i) = y(t_i), \qquad s'''(t_2^-) = s'''(t_2^+), \quad
        s'''(t_{n-1}^-) = s'''(t_{n-1}^+)

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

    provides: ClassVar[frozenset[str]] = _Interpolation.provides | {"moves along"}

    @staticmethod
    def _between(knots: Frames, values: Frames, times: Frames) -> Frames:
        # With three or two knots, SciPy's not-a-knot condition is the parabola or the line.
        return np.asarray(CubicSpline(knots, values, bc_type="not-a-knot")(times))
