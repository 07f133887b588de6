"""What the Gaussian-process models share: scaling, training, prediction and draws."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from numbers import Integral
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray
from sklearn.utils import check_scalar
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.gp.kernels import KERNELS
from mocapbench.baselines.gp.parameters import Parameters
from mocapbench.baselines.gp.planner import PLANS
from mocapbench.baselines.gp.prediction import infer
from mocapbench.baselines.gp.reduction import Reduction, Share
from mocapbench.baselines.gp.replicates import Replicates
from mocapbench.baselines.gp.sampling import draw_layer
from mocapbench.baselines.gp.scaling import Standardisation
from mocapbench.baselines.gp.start import bounds, data_driven, perturbed
from mocapbench.baselines.gp.training import Training, maximise
from mocapbench.baselines.pooling import check_recordings
from mocapbench.baselines.protocols import (
    Imputer,
    Prediction,
    SampleByFrameByChannel,
    Synthesiser,
)
from mocapbench.datasets import FrameByChannel, Frames, Recording

__all__ = ["GaussianProcess"]

Array = NDArray[np.float64]


class GaussianProcess(Imputer, Synthesiser):
    """A linear model of coregionalisation, or two, trained by type-II maximum likelihood.

    Parameters
    ----------
    n_components : int, default=1
        Number Q of components of each layer.
    rank : int, default=1
        Number of columns of each W_q; 0 makes the outputs independent.
    kernel : {"rbf", "matern12", "matern32", "matern52"}, default="matern32"
        The kernel of every component.
    n_restarts : int, default=1
        Number of searches; the first starts from the data, the others at random around it.
    max_iter : int, default=1000
        Largest number of iterations of a search.
    solver : {"auto", "dense", "latent-split", "state-space"}, default="auto"
        How the likelihood is computed; "auto" takes the solver with the least counted work.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the random starts.

    Attributes
    ----------
    parameters_ : Parameters
        Maximum-likelihood parameters, for outputs in standard units.
    log_likelihood_ : float
        Log-likelihood of the recordings in their own units.
    training_ : Training
        The searches, with their counts and messages.
    converged_, n_iterations_, n_evaluations_ : bool, int, int
        Those of the best search.
    solver_ : str
        The solver that was used.
    coregionalisation_ : dict of str to ndarray of shape (Q, D, D)
        The matrices B_q of each layer, in the outputs' own units.
    noise_ : ndarray of shape (D,)
        Noise variances, in the outputs' own units.
    """

    layers: ClassVar[tuple[str, ...]]
    """The layers of the model; the last is the one that new recordings are drawn from."""

    def __init__(
        self,
        *,
        n_components: int = 1,
        rank: int = 1,
        kernel: str = "matern32",
        n_restarts: int = 1,
        max_iter: int = 1000,
        solver: str = "auto",
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_components = n_components
        self.rank = rank
        self.kernel = kernel
        self.n_restarts = n_restarts
        self.max_iter = max_iter
        self.solver = solver
        self.random_state = random_state

    @staticmethod
    @abstractmethod
    def reduce(replicates: Replicates) -> Reduction:
        """Return the likelihood of replicates in standard units as block problems."""

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Find the parameters of largest likelihood.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, a name
            repeats, or a channel is nowhere visible.
        SingularCovarianceError
            If the covariance is singular at a start.
        """
        self._check_parameters()
        checked = check_recordings(recordings)
        self.scaling_ = Standardisation.of(checked)
        self.recordings_ = {recording.name: recording for recording in checked}
        replicates = Replicates.align([self.scaling_.apply(recording) for recording in checked])
        self.reduction_ = self.reduce(replicates)
        self._train(replicates)
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the predictive distributions of recordings that `fit` has seen.

        Raises
        ------
        ValueError
            If a recording was not given to `fit`, or not with these times and values.
        """
        check_is_fitted(self)
        names = list(self.recordings_)
        for recording in recordings:
            self._check_seen(recording)
        shares = [self.reduction_.replicates[names.index(rec.name)] for rec in recordings]
        curves = self._infer(shares, [recording.times for recording in recordings])
        return [
            Prediction.around(recording, mean, variance + self.noise_)
            for recording, (mean, variance) in zip(recordings, curves, strict=True)
        ]

    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return draws around the trend's posterior mean, (n, N, D), noise included."""
        check_is_fitted(self)
        rng = np.random.default_rng(random_state)
        times = np.asarray(times, dtype=np.float64)
        layer = self.parameters_.layers[self.layers[-1]]
        draws = draw_layer(KERNELS[self.kernel], layer, times, n_samples, rng)
        draws += np.sqrt(self.parameters_.noise) * rng.standard_normal(draws.shape)
        ((trend, _),) = self._infer([self.reduction_.trend], [times])
        return trend + self.scaling_.scale * draws

    def covariance(self, layer: str, times: Frames) -> Array:
        """Return Σ_q B_q ⊗ k_q of a layer in the outputs' own units, (D N, D N).

        Outputs are slowest, as in `ToyProcess`.
        """
        check_is_fitted(self)
        lags = np.subtract.outer(times, times)
        scales = self.parameters_.layers[layer].lengthscales[:, None, None]
        kernels = KERNELS[self.kernel].value(lags, scales)
        blocks = np.tensordot(self.coregionalisation_[layer], kernels, axes=(0, 0))
        size = len(self.noise_) * len(lags)
        return blocks.transpose(0, 2, 1, 3).reshape(size, size)

    @property
    def coregionalisation_(self) -> Mapping[str, Array]:
        """The matrices B_q of each layer, (Q, D, D), in the outputs' own units."""
        units = np.outer(self.scaling_.scale, self.scaling_.scale)
        layers = self.parameters_.layers.items()
        return {name: layer.coregionalisation.matrices * units for name, layer in layers}

    @property
    def noise_(self) -> Array:
        """(D,) noise variances in the outputs' own units."""
        return self.parameters_.noise * self.scaling_.scale**2

    def _train(self, replicates: Replicates) -> None:
        reduction = self.reduction_
        start = data_driven(
            replicates, self.layers, self.n_components, self.rank, reduction.within_variance
        )
        rng = np.random.default_rng(self.random_state)
        others = [perturbed(start, rng) for _ in range(self.n_restarts - 1)]
        self._solver = PLANS[self.solver](KERNELS[self.kernel], reduction, start)
        self.training_: Training = maximise(
            lambda parameters: reduction.evaluate(self._solver, parameters),
            [start, *others],
            bounds(start, replicates.times),
            self.max_iter,
        )
        best = self.training_.best
        self.parameters_: Parameters = best.parameters
        self.log_likelihood_ = best.log_likelihood + self.scaling_.log_jacobian
        self.converged_, self.n_iterations_ = best.converged, best.n_iterations
        self.n_evaluations_, self.solver_ = best.n_evaluations, self._solver.name

    def _infer(
        self, curves: Sequence[tuple[Share, ...]], times: Sequence[Frames]
    ) -> list[tuple[FrameByChannel, FrameByChannel]]:
        """Return mean and variance of noise-free curves in the outputs' own units."""
        inferred = infer(self.reduction_, self._solver, self.parameters_, curves, times)
        return [
            (self.scaling_.restore(mean), variance * self.scaling_.scale**2)
            for mean, variance in inferred
        ]

    def _check_parameters(self) -> None:
        for name, least in (("n_components", 1), ("rank", 0), ("n_restarts", 1), ("max_iter", 1)):
            check_scalar(getattr(self, name), name, Integral, min_val=least)
        for name, choices in (("kernel", KERNELS), ("solver", PLANS)):
            if getattr(self, name) not in choices:
                raise ValueError(
                    f"expected {name} to be one of {sorted(choices)}, got {getattr(self, name)!r}"
                )

    def _check_seen(self, recording: Recording) -> None:
        fitted = self.recordings_.get(recording.name)
        if fitted is None:
            raise ValueError(
                f"expected recordings that fit has seen, {sorted(self.recordings_)}, got "
                f"{recording.name!r}: give it to fit together with the others"
            )
        same = np.array_equal(fitted.times, recording.times) and np.array_equal(
            fitted.values, recording.values, equal_nan=True
        )
        if not same:
            raise ValueError(
                f"recording {recording.name!r} differs from the one of that name given to fit: "
                "expected the same times, visible values and hidden entries; fit again"
            )
