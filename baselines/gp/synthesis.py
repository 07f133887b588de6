"""What a trained model draws: new recordings around the trend."""

from __future__ import annotations

import numpy as np
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.validation import check_choice, check_sampling
from mocapbench.baselines.gp.covariances import LearntCovariances
from mocapbench.baselines.gp.posterior.trends import TRENDS
from mocapbench.baselines.protocols import SampleByFrameByChannel, Synthesiser
from mocapbench.datasets import Frames

__all__ = ["NewRecordings"]


class NewRecordings(LearntCovariances, Synthesiser):
    """A trained model that draws new recordings."""

    sampled_trend: str

    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return draws of new recordings, noise included.

        Each is the trend (see ``sampled_trend``; the outputs' means if the model has none) plus
        independent draws of the layers below it, or of the only layer. The covariances are
        factorised once for all draws.

        Parameters
        ----------
        times : ndarray of shape (N,)
            In seconds, in any order.
        n_samples : int
            Number n of recordings.
        random_state : int or numpy.random.Generator
            Seed of the draws.

        Returns
        -------
        ndarray of shape (n, N, D)
            In the outputs' own units.

        Raises
        ------
        sklearn.exceptions.NotFittedError
            If `fit` has not been called.
        ValueError
            If the number of recordings is not a positive integer, or times, the seed or
            ``sampled_trend`` are invalid.
        """
        check_is_fitted(self)
        check_choice("sampled_trend", self.sampled_trend, TRENDS)
        times = check_sampling(times, n_samples, random_state, increasing=False)
        rng = np.random.default_rng(random_state)
        with self._threaded_process() as process:
            trend = TRENDS[self.sampled_trend](process, times, rng)
            layers = self.layers[1:] or self.layers
            return process.draw_recordings(layers, trend, times, n_samples, rng)
