"""The base class of models with one independent Gaussian process for each channel."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from typing import ClassVar, Self

import numpy as np

from mocapbench.baselines.common.checks import check_recordings
from mocapbench.baselines.common.validation import check_positive, check_seed
from mocapbench.baselines.gp.channel_posteriors import ChannelPosteriors, Single
from mocapbench.datasets import Recording

__all__ = ["Channelwise"]


class Channelwise(ChannelPosteriors[Single]):
    """A separate model for each channel, with separate parameters.

    N is the number of frames of a recording, D that of channels, Q that of components of a layer.

    Parameters
    ----------
    n_components : int or mapping of str to int, default=1
        Number Q of kernels that are added up in every layer of a channel, or in each layer by its
        name.
    kernel : {"rbf", "matern12", "matern32", "matern52"}, default="matern32"
        The kernel of every component.
    n_restarts : int, default=1
        Number of searches for each channel. The first starts from the data, the next four with its
        lengthscales assigned otherwise, the others at random around it. Of starts that are the
        same, as with one component, one is searched.
    max_iter : int, default=1000
        Largest number of iterations of a search.
    tol : float, default=1e-7
        Relative gain of an iteration below which a search has converged, as in `GaussianProcess`.
    max_seconds : float or None, default=None
        Time for all channels together, in seconds, divided evenly between them; None sets no
        limit.
    warm_start : bool, default=False
        Whether `fit` starts from the parameters of the previous fit, if there was one.
    verbose : bool, default=False
        Whether `fit` prints a line for every iteration.
    solver : {"auto", "dense", "latent-split", "state-space", "kronecker"}, default="auto"
        How the likelihood is computed, as in `GaussianProcess`.
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

    family: ClassVar[str] = "Gaussian processes"

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
        models = self._unfitted(checked[0].channels)
        self.channels_, self.units_ = checked[0].channels, checked[0].units
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

    def _unfitted(self, channels: Sequence[str]) -> Mapping[str, Single]:
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
