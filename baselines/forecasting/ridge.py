"""Ridge regression of the next frames on the last few."""

from __future__ import annotations

from sklearn.linear_model import Ridge

from mocapbench.baselines.common.validation import check_positive
from mocapbench.baselines.forecasting.windows import (
    WindowByFrameByChannel,
    WindowForecaster,
    describe_windows,
    follow_last_frame,
    leave_last_frame,
)

__all__ = ["RidgeForecast"]


class RidgeForecast(WindowForecaster):
    r"""Predict how the next frames differ from the last one seen, by ridge regression.

    The regressors are the last frame and the distances of the others from it. All windows of
    the recordings count alike. There is no predictive distribution.

    Parameters
    ----------
    n_seen : int, default=10
        How many frames before the first hidden one it looks at.
    n_ahead : int, default=25
        How many frames it can predict.
    penalty : float, default=10.0
        Of the squared coefficients, for windows in centimetres.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.

    Notes
    -----
    With x a window and z how far the next frames are from its last one,

    .. math:: \min_{B, c} \sum_w \| z_w - B^\top x_w - c \|^2 + \lambda \| B \|^2

    References
    ----------
    A. E. Hoerl and R. W. Kennard (1970), Ridge Regression: Biased Estimation for Nonorthogonal
    Problems, Technometrics 12(1).

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import RidgeForecast
    >>> from mocapbench.datasets import Recording
    >>> times = np.arange(40.0)
    >>> wave = Recording("wave", times, np.sin(times)[:, None], ("knee",), ("cm",))
    >>> given = wave.hide((times > 35)[:, None])
    >>> model = RidgeForecast(n_seen=3, n_ahead=4, penalty=1e-6).fit([wave])
    >>> bool(np.abs(model.impute([given])[0].mean - wave.values).max() < 1e-3)
    True
    """

    def __init__(self, n_seen: int = 10, n_ahead: int = 25, *, penalty: float = 10.0) -> None:
        self.n_seen = n_seen
        self.n_ahead = n_ahead
        self.penalty = penalty

    def _check_parameters(self) -> None:
        check_positive("penalty", self.penalty)

    def _learn(self, seen: WindowByFrameByChannel, ahead: WindowByFrameByChannel) -> None:
        regression = Ridge(alpha=self.penalty)
        self._regression = regression.fit(describe_windows(seen), leave_last_frame(seen, ahead))

    def _predict(self, seen: WindowByFrameByChannel) -> WindowByFrameByChannel:
        return follow_last_frame(seen, self._regression.predict(describe_windows(seen)))
