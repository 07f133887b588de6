"""The mean of what followed the nearest windows."""

from __future__ import annotations

import numpy as np
from sklearn.neighbors import NearestNeighbors

from mocapbench.baselines.common.validation import check_count, check_share
from mocapbench.baselines.forecasting.windows import (
    WindowByFrameByChannel,
    WindowForecaster,
    describe_windows,
)
from mocapbench.basics.arrays import Array

__all__ = ["NeighbourForecast"]


class NeighbourForecast(WindowForecaster):
    r"""Predict what followed the nearest windows, relative to a step that dies away.

    The last step is repeated, ever smaller; what is averaged over the nearest windows is how far
    the truth went from there. There is no predictive distribution.

    Parameters
    ----------
    n_seen : int, default=10
        How many frames before the first hidden one it looks at.
    n_ahead : int, default=25
        How many frames it can predict.
    n_neighbors : int, default=32
        Number of windows that are averaged; all, if there are fewer.
    damping : float, default=0.9
        Ratio of each step to the one before.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.

    Notes
    -----
    With a the last frame seen, γ the damping, and N(x) the nearest windows:

    .. math::

        \hat y_{a+k} = d_{a+k} + \frac{1}{|N(x)|} \sum_{i \in N(x)} (y^i_{a+k} - d^i_{a+k}), \qquad
        d_{a+k} = y_a + (y_a - y_{a-1}) \sum_{j=1}^k \gamma^j

    References
    ----------
    L. Kovar, M. Gleicher and F. Pighin (2002), Motion Graphs, ACM Transactions on Graphics 21(3):
    motions continue where another is near.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import NeighbourForecast
    >>> from mocapbench.datasets import Recording
    >>> times = np.arange(40.0)
    >>> wave = Recording("wave", times, np.sin(times)[:, None], ("knee",), ("cm",))
    >>> given = wave.hide((times > 35)[:, None])
    >>> model = NeighbourForecast(n_seen=3, n_ahead=4, n_neighbors=1).fit([wave])
    >>> bool(np.abs(model.impute([given])[0].mean - wave.values).max() < 1e-6)
    True
    """

    def __init__(
        self, n_seen: int = 10, n_ahead: int = 25, *, n_neighbors: int = 32, damping: float = 0.9
    ) -> None:
        self.n_seen = n_seen
        self.n_ahead = n_ahead
        self.n_neighbors = n_neighbors
        self.damping = damping

    def _check_parameters(self) -> None:
        check_count("n_neighbors", self.n_neighbors, 1)
        check_share("damping", self.damping)

    def _learn(self, seen: WindowByFrameByChannel, ahead: WindowByFrameByChannel) -> None:
        self._apart = ahead - self._repeat_step(seen)
        n_neighbors = min(self.n_neighbors, len(seen))
        self._index = NearestNeighbors(n_neighbors=n_neighbors).fit(describe_windows(seen))

    def _predict(self, seen: WindowByFrameByChannel) -> WindowByFrameByChannel:
        nearest = self._index.kneighbors(describe_windows(seen), return_distance=False)
        apart = np.stack([self._apart[few].mean(axis=0) for few in nearest])
        return np.asarray(self._repeat_step(seen) + apart)

    def _repeat_step(self, seen: WindowByFrameByChannel) -> Array:
        """Return where the last step leads (W, n_ahead, D) that is repeated, ever smaller."""
        sums = np.cumsum(self.damping ** np.arange(1, self.n_ahead + 1))
        step = seen[:, -1:] - seen[:, -2:-1]
        return np.asarray(seen[:, -1:] + sums[:, None] * step)
