"""The trivial model: one Gaussian for each channel, the same at all times."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_recordings, check_visible, pool
from mocapbench.baselines.common.recordings import by_content, visible_moments
from mocapbench.baselines.protocols import Imputer, Inductive, Prediction
from mocapbench.datasets import Recording

__all__ = ["Trivial"]

_LEAST_VARIANCE = 1e-12


class Trivial(Imputer, Inductive):
    r"""Predict the mean and variance of each channel’s visible entries, whatever the time.

    They are those of the visible entries of all recordings given to `fit` and `impute` (ddof 0).
    The mean standardised log loss (MSLL) is defined relative to this Gaussian, so that this model
    has an MSLL of 0. The variance is at least 1e-12, because a predictive variance is positive.

    Attributes
    ----------
    recordings_ : tuple of Recording
        The recordings given to `fit`.

    Notes
    -----
    With V the visible entries (k, t) of channel d:

    .. math::

        \mu_d = \frac{1}{|V|} \sum_{(k, t) \in V} y_{ktd}, \qquad
        \sigma_d^2 = \frac{1}{|V|} \sum_{(k, t) \in V} (y_{ktd} - \mu_d)^2

    References
    ----------
    C. E. Rasmussen and C. K. I. Williams (2006), Gaussian Processes for Machine Learning, MIT
    Press, §2.5: the trivial model of the standardised log loss.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import Trivial
    >>> from mocapbench.datasets import Recording
    >>> values = [[1.0], [3.0], [np.nan]]
    >>> recording = Recording("short", np.arange(3.0), values, ("knee",), ("deg",))
    >>> (prediction,) = Trivial().fit([recording]).impute([recording])
    >>> prediction.mean[:, 0], prediction.variance[:, 0]
    (array([1., 3., 2.]), array([0., 0., 1.]))
    """

    family: ClassVar[str] = "References"
    provides: ClassVar[frozenset[str]] = Imputer.provides | Inductive.provides | {"scales along"}

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Keep the recordings.

        Raises
        ------
        ValueError
            If there is no recording, channels differ, or a name repeats.
        """
        self.recordings_: tuple[Recording, ...] = by_content(check_recordings(recordings))
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
