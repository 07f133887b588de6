"""The trivial model: a Gaussian per channel that knows nothing of time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import numpy as np
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.recordings import (
    check_recordings,
    check_visible,
    pool,
    visible_moments,
)
from mocapbench.baselines.protocols import Imputer, Inductive, Prediction
from mocapbench.datasets import Recording

__all__ = ["Trivial"]

_LEAST_VARIANCE = 1e-12


class Trivial(Imputer, Inductive):
    """Predict each channel's visible mean and variance.

    The Gaussian is that of the visible entries of all recordings given to `fit` and `impute`
    (ddof 0), which is the yardstick of the mean standardised log loss: this model scores 0. A
    constant channel gets variance 1e-12, because a predictive variance is positive.

    Attributes
    ----------
    recordings_ : tuple of Recording
        The recordings given to `fit`.
    """

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Keep the recordings.

        Raises
        ------
        ValueError
            If there is none, their channels differ, or a name repeats.
        """
        self.recordings_ = check_recordings(recordings)
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the same mean and variance at every hidden entry of a channel.

        Raises
        ------
        ValueError
            If a channel has no visible entry in any recording.
        """
        check_is_fitted(self)
        pooled = pool(self.recordings_, recordings)
        check_visible(pooled)
        mean, variance = visible_moments(pooled)
        floored = np.maximum(variance, _LEAST_VARIANCE)
        return [Prediction.around(recording, mean, floored) for recording in recordings]
