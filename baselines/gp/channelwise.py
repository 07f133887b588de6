"""What models have in common that are one Gaussian process a channel, nothing shared."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from typing import Generic, Self, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.recordings import check_recordings
from mocapbench.baselines.common.validation import check_positive
from mocapbench.baselines.gp.estimator import GaussianProcess
from mocapbench.baselines.protocols import (
    Imputer,
    Prediction,
    SampleByFrameByChannel,
    Synthesiser,
)
from mocapbench.datasets import Frames, Recording

__all__ = ["Channelwise"]

Single = TypeVar("Single", bound=GaussianProcess)
"""The model of a channel."""


class Channelwise(Imputer, Synthesiser, Generic[Single]):
    """A model for each channel on its own, with parameters of its own.

    Parameters
    ----------
    n_components : int or mapping of str to int, default=1
        Number of kernels that are added in each channel, of each layer or of every layer by its
        name.
    kernel : {"rbf", "matern12", "matern32", "matern52"}, default="matern32"
        The kernel of every component.
    n_restarts : int, default=1
        Number of searches a channel; the first starts from the data.
    max_iter : int, default=1000
        Largest number of iterations of a search.
    tol : float, default=1e-7
        Relative gain of an iteration at which a search has converged, as in `GaussianProcess`.
    max_seconds : float or None, default=None
        Time for all channels together, of which each gets an even share.
    warm_start : bool, default=False
        Whether `fit` starts from the parameters of the last one, where there was one.
    verbose : bool, default=False
        Whether `fit` prints a line for every iteration.
    solver : {"auto", "dense", "latent-split", "state-space"}, default="auto"
        How the likelihood is computed.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the random starts.

    Attributes
    ----------
    models_ : tuple of GaussianProcess
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

    models_: tuple[Single, ...]

    def __init__(
        self,
        *,
        n_components: int | Mapping[str, int] = 1,
        kernel: str = "matern32",
        n_restarts: int = 1,
        max_iter: int = 1000,
        tol: float = 1e-7,
        max_seconds: float | None = None,
        warm_start: bool = False,
        verbose: bool = False,
        solver: str = "auto",
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_components = n_components
        self.kernel = kernel
        self.n_restarts = n_restarts
        self.max_iter = max_iter
        self.tol = tol
        self.max_seconds = max_seconds
        self.warm_start = warm_start
        self.verbose = verbose
        self.solver = solver
        self.random_state = random_state

    @staticmethod
    @abstractmethod
    def of_one_channel() -> Single:
        """Return an unfitted model of one channel."""

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Find each channel's parameters of largest likelihood.

        Raises
        ------
        ValueError
            As `GaussianProcess.fit`.
        """
        checked = check_recordings(recordings)
        models = self._unfitted(checked[0].channels)
        self.channels_ = tuple(models)
        self.models_ = tuple(
            model.fit([recording.select([channel]) for recording in checked])
            for channel, model in models.items()
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

    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return new recordings, noise included, (n, N, D), as `GaussianProcess.sample`."""
        check_is_fitted(self)
        rng = np.random.default_rng(random_state)
        return np.dstack([model.sample(times, n_samples, rng) for model in self.models_])

    def posterior_covariance(
        self, recording: Recording, times: Frames | None = None
    ) -> NDArray[np.float64]:
        """Return the joint covariance of a recording's curve, (D M, D M), channel by channel.

        As `GaussianProcess.posterior_covariance`; channels do not covary.
        """
        check_is_fitted(self)
        return np.asarray(
            block_diag(
                *(
                    model.posterior_covariance(recording.select([channel]), times)
                    for channel, model in zip(self.channels_, self.models_, strict=True)
                )
            )
        )

    def posterior_draws(
        self,
        recording: Recording,
        n_samples: int,
        random_state: int | np.random.Generator,
        times: Frames | None = None,
    ) -> SampleByFrameByChannel:
        """Return draws of a recording's curve, (n, M, D), as `GaussianProcess.posterior_draws`."""
        check_is_fitted(self)
        rng = np.random.default_rng(random_state)
        return np.dstack(
            [
                model.posterior_draws(recording.select([channel]), n_samples, rng, times)
                for channel, model in zip(self.channels_, self.models_, strict=True)
            ]
        )

    def _unfitted(self, channels: Sequence[str]) -> Mapping[str, Single]:
        """Return a model for each channel; a warm start takes up the last one of that channel."""
        settings = self.get_params() | {"random_state": np.random.default_rng(self.random_state)}
        if self.max_seconds is not None:
            check_positive("max_seconds", self.max_seconds)
            settings["max_seconds"] = self.max_seconds / len(channels)
        last: Mapping[str, Single] = {}
        if self.warm_start and hasattr(self, "models_"):
            last = dict(zip(self.channels_, self.models_, strict=True))
        return {
            channel: last.get(channel, self.of_one_channel()).set_params(**settings)
            for channel in channels
        }
