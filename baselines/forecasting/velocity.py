"""The last step, repeated."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np

from mocapbench.baselines.common.checks import check_given, check_recordings
from mocapbench.baselines.forecasting.windows import count_ahead
from mocapbench.baselines.protocols import Forecaster, Inductive, Prediction
from mocapbench.datasets import FrameByChannel, Recording

__all__ = ["ConstantVelocity"]


class ConstantVelocity(Forecaster, Inductive):
    r"""Continue each channel along the line through its last two visible frames.

    A recording of one visible frame is held. It learns nothing, and there is no predictive
    distribution.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.

    Notes
    -----
    With a the last visible frame:

    .. math:: \hat y_{a + k} = y_a + k \, (y_a - y_{a - 1})

    References
    ----------
    J. Martinez, M. J. Black and J. Romero (2017), On Human Motion Prediction Using Recurrent Neural
    Networks, CVPR: simple baselines of this kind are hard to beat at first.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import ConstantVelocity
    >>> from mocapbench.datasets import Recording
    >>> values = [[1.0], [3.0], [np.nan], [np.nan]]
    >>> recording = Recording("short", np.arange(4.0), values, ("x",), ("cm",))
    >>> ConstantVelocity().fit([recording]).impute([recording])[0].mean[:, 0]
    array([1., 3., 5., 7.])
    """

    family: ClassVar[str] = "Forecasts"
    provides: ClassVar[frozenset[str]] = Forecaster.provides | Inductive.provides | {"scales along"}

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Keep the channels.

        Raises
        ------
        ValueError
            If there is no recording, channels differ, or a name repeats.
        """
        checked = check_recordings(recordings)
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the lines after the last visible frame of each recording.

        Raises
        ------
        ValueError
            If channels differ, or others than the last frames are hidden.
        """
        check_given(self, recordings)
        return [Prediction.around(each, _extend_line(each)) for each in recordings]


def _extend_line(recording: Recording) -> FrameByChannel:
    """Return the values (N, D) with a line after the last visible frame."""
    last = len(recording.times) - count_ahead(recording) - 1
    step = recording.values[last] - recording.values[max(last - 1, 0)]
    ahead = np.maximum(np.arange(len(recording.times)) - last, 0)
    return np.asarray(recording.values[last] + ahead[:, None] * step)
