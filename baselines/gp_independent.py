"""One Gaussian process a channel: no sharing between channels, nor between recordings.

The kernel's parameters are learnt from all recordings, as independent draws; a prediction rests on
the recording itself. A model that cannot beat it has learnt nothing from the others.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import numpy as np
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.lmc_independent import LMCIndependent
from mocapbench.baselines.pooling import check_recordings
from mocapbench.baselines.protocols import Imputer, Prediction
from mocapbench.datasets import Recording

__all__ = ["GPIndependent"]


class GPIndependent(Imputer):
    """A Gaussian process and noise for each channel on its own.

    Parameters
    ----------
    n_components : int, default=1
        Number of kernels that are added in each channel.
    kernel : {"rbf", "matern12", "matern32", "matern52"}, default="matern32"
        The kernel of every component.
    n_restarts : int, default=1
        Number of searches a channel; the first starts from the data.
    max_iter : int, default=1000
        Largest number of iterations of a search.
    solver : {"auto", "dense", "latent-split", "state-space"}, default="auto"
        How the likelihood is computed.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the random starts.

    Attributes
    ----------
    models_ : tuple of LMCIndependent
        The model of each channel.
    log_likelihood_ : float
        Log-likelihood of the recordings in their own units.
    converged_ : bool
        Whether every channel's search converged.
    n_iterations_, n_evaluations_ : int
        Totals over the channels.
    solver_ : str
        The solvers that were used.
    """

    def __init__(
        self,
        *,
        n_components: int = 1,
        kernel: str = "matern32",
        n_restarts: int = 1,
        max_iter: int = 1000,
        solver: str = "auto",
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_components = n_components
        self.kernel = kernel
        self.n_restarts = n_restarts
        self.max_iter = max_iter
        self.solver = solver
        self.random_state = random_state

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Find each channel's parameters of largest likelihood.

        Raises
        ------
        ValueError
            As `LMCIndependent.fit`.
        """
        checked = check_recordings(recordings)
        settings = self.get_params() | {"random_state": np.random.default_rng(self.random_state)}
        self.channels_ = checked[0].channels
        self.models_ = tuple(
            LMCIndependent(rank=0, **settings).fit([rec.select([channel]) for rec in checked])
            for channel in self.channels_
        )
        self.log_likelihood_ = sum(model.log_likelihood_ for model in self.models_)
        self.converged_ = all(model.converged_ for model in self.models_)
        self.n_iterations_ = sum(model.n_iterations_ for model in self.models_)
        self.n_evaluations_ = sum(model.n_evaluations_ for model in self.models_)
        self.solver_ = "+".join(sorted({model.solver_ for model in self.models_}))
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the predictive distributions of recordings that `fit` has seen.

        Raises
        ------
        ValueError
            If a recording was not given to `fit`, or not with these times and values.
        """
        check_is_fitted(self)
        by_channel = [
            model.impute([recording.select([channel]) for recording in recordings])
            for channel, model in zip(self.channels_, self.models_, strict=True)
        ]
        return [
            Prediction(
                np.hstack([prediction.mean for prediction in predictions]),
                np.hstack([prediction.variance for prediction in predictions]),
            )
            for predictions in zip(*by_channel, strict=True)
        ]
