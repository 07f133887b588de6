"""The base class of models with one independent Gaussian process for each channel."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, Generic, Self, TypeVar

import numpy as np
from scipy.linalg import block_diag
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_given, check_recordings
from mocapbench.baselines.common.validation import (
    check_count,
    check_positive,
    check_sampling,
    check_seed,
)
from mocapbench.baselines.gp.estimator import GaussianProcess
from mocapbench.baselines.gp.parameter_docs import document_like
from mocapbench.baselines.protocols import (
    Imputer,
    Prediction,
    SampleByFrameByChannel,
    Synthesiser,
)
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Frames, Recording

__all__ = ["Channelwise"]

Single = TypeVar("Single", bound=GaussianProcess)
"""The model of one channel."""


@document_like(GaussianProcess)
@dataclass(kw_only=True, eq=False, repr=False)
class Channelwise(Imputer, Synthesiser, Generic[Single]):
    """A separate model for each channel, with separate parameters.

    N is the number of frames of a recording, D that of channels, Q that of components of a layer.

    Parameters
    ----------
    n_components : int or mapping of str to int, default=1
        Number Q of kernels that are added up in every layer of a channel, or in each layer by its
        name, such as ``{"parent": 2, "child": 1}``.
    n_restarts : int, default=1
        Number of searches for each channel. The first starts from the data, the next four with its
        lengthscales assigned otherwise, the others at random around it. Of starts that are the
        same, as with one component, one is searched.
    max_seconds : float or None, default=None
        Time limit for all channels together, divided equally; None sets no limit.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
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

    family: ClassVar[str] = "Gaussian processes"
    provides: ClassVar[frozenset[str]] = Imputer.provides | Synthesiser.provides | {"scales along"}
    max_frames: ClassVar[int | None] = 200

    n_components: int | Mapping[str, int] = 1
    kernel: str = "matern32"
    n_restarts: int = 1
    max_iter: int = 1000
    tol: float = 1e-7
    max_seconds: float | None = None
    warm_start: bool = False
    verbose: bool = False
    solver: str = "auto"
    random_state: int | np.random.Generator | None = None

    @staticmethod
    @abstractmethod
    def of_one_channel() -> Single:
        """Return an unfitted model of one channel."""

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Find the parameters of largest likelihood of every channel.

        Parameters
        ----------
        recordings : sequence of Recording
            Recordings with the same channels and different names; NaN marks a hidden entry.

        Returns
        -------
        Channelwise
            The model itself.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, a name
            repeats, or a channel is nowhere visible.
        SingularCovarianceError
            If the covariance of a channel is singular at a start.
        """
        checked = check_recordings(recordings)
        models = self._build_models(checked[0].channels)
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        self.models_: tuple[Single, ...] = tuple(
            model.fit([recording.select([channel]) for recording in checked])
            for channel, model in models.items()
        )
        self.log_likelihood_: float = sum(model.log_likelihood_ for model in self.models_)
        self.converged_: bool = all(model.converged_ for model in self.models_)
        self.n_iterations_: int = sum(model.n_iterations_ for model in self.models_)
        self.n_evaluations_: int = sum(model.n_evaluations_ for model in self.models_)
        self.solver_: str = "+".join(sorted({model.solver_ for model in self.models_}))
        return self

    def _build_models(self, channels: Sequence[str]) -> Mapping[str, Single]:
        """Return a model to fit for each channel; a warm start takes the channel's previous one."""
        check_seed("random_state", self.random_state)
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

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the posterior of recordings given to `fit`, as `MOHGP.impute` does."""
        by_channel = [model.impute(alone) for model, alone in self._by_channel(recordings)]
        return [_stack_channels(channels) for channels in zip(*by_channel, strict=True)]

    def leave_one_out(self, recordings: Sequence[Recording]) -> list[tuple[Prediction, Array]]:
        """Return the posterior of recordings, and the errors of visible entries left out: (N, D).

        See `MOHGP.leave_one_out`.
        """
        by_channel = [model.leave_one_out(alone) for model, alone in self._by_channel(recordings)]
        stacked = []
        for channels in zip(*by_channel, strict=True):
            nominal, ratios = zip(*channels, strict=True)
            stacked.append((_stack_channels(nominal), np.hstack(ratios)))
        return stacked

    def impute_held_out(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the posterior of recordings given to `fit` of which more is hidden."""
        by_channel = [model.impute_held_out(alone) for model, alone in self._by_channel(recordings)]
        return [_stack_channels(channels) for channels in zip(*by_channel, strict=True)]

    def _by_channel(
        self, recordings: Sequence[Recording]
    ) -> Iterator[tuple[Single, list[Recording]]]:
        """Yield the model of each channel, and that channel of each recording."""
        check_given(self, recordings)
        for channel, model in zip(self.channels_, self.models_, strict=True):
            yield model, [recording.select([channel]) for recording in recordings]

    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return draws of new recordings, noise included, as `MOHGP.sample` does.

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
            In the channels' own units.

        Raises
        ------
        sklearn.exceptions.NotFittedError
            If `fit` has not been called.
        ValueError
            If the number of recordings is not a positive integer, or times or the seed are invalid.
        """
        check_is_fitted(self)
        check_sampling(times, n_samples, random_state, increasing=False)
        rng = np.random.default_rng(random_state)
        return np.dstack([model.sample(times, n_samples, rng) for model in self.models_])

    def posterior_covariance(self, recording: Recording, times: Frames | None = None) -> Array:
        """Return the joint covariance of a recording's curve, as `MOHGP.posterior_covariance` does.

        Covariances between different channels are 0.

        Parameters
        ----------
        recording : Recording
            One that was given to `fit`.
        times : ndarray of shape (M,), optional
            In seconds, in any order; the recording's times if left out.

        Returns
        -------
        ndarray of shape (D M, D M)
            In the channels' own units, with channels slowest.
        """
        of_channels = [
            model.posterior_covariance(alone, times)
            for model, (alone,) in self._by_channel([recording])
        ]
        return np.asarray(block_diag(*of_channels))

    def posterior_draws(
        self,
        recording: Recording,
        n_samples: int,
        random_state: int | np.random.Generator,
        times: Frames | None = None,
    ) -> SampleByFrameByChannel:
        """Return draws of a recording's curve without noise, as `MOHGP.posterior_draws` does.

        Parameters
        ----------
        recording : Recording
            One that was given to `fit`.
        n_samples : int
            Number n of draws.
        random_state : int or numpy.random.Generator
            Seed of the draws.
        times : ndarray of shape (M,), optional
            In seconds, in any order; the recording's times if left out.

        Returns
        -------
        ndarray of shape (n, M, D)
            In the channels' own units.
        """
        alone = list(self._by_channel([recording]))
        check_count("n_samples", n_samples, 1)
        check_seed("random_state", random_state)
        rng = np.random.default_rng(random_state)
        return np.dstack(
            [model.posterior_draws(one, n_samples, rng, times) for model, (one,) in alone]
        )


def _stack_channels(channels: Sequence[Prediction]) -> Prediction:
    """Return the predictions of the channels of a recording, with variances, as one."""
    return Prediction(
        np.hstack([channel.mean for channel in channels]),
        np.hstack([np.asarray(channel.variance) for channel in channels]),
    )
