"""What the Gaussian-process models share: scaling, training, prediction and draws."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Self

import numpy as np
from joblib import effective_n_jobs
from numpy.typing import NDArray
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.recordings import check_recordings
from mocapbench.baselines.common.scaling import Standardisation
from mocapbench.baselines.common.threads import mapping
from mocapbench.baselines.common.validation import (
    check_choice,
    check_count,
    check_jobs,
    check_positive,
    components_of,
)
from mocapbench.baselines.gp.planner import PLANS, name_of, reason, with_mapper
from mocapbench.baselines.gp.posterior.fitted import FittedProcess
from mocapbench.baselines.gp.posterior.trends import TRENDS
from mocapbench.baselines.gp.prior.kernels import KERNELS
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.reduction.reduction import Reduction, Share
from mocapbench.baselines.gp.reduction.replicates import Replicates
from mocapbench.baselines.gp.reduction.tree import Tree
from mocapbench.baselines.gp.training.coordinates import Coordinates
from mocapbench.baselines.gp.training.maximum_likelihood import (
    Budget,
    Space,
    Step,
    Training,
    maximise,
)
from mocapbench.baselines.gp.training.start import bounds, data_driven, perturbed
from mocapbench.baselines.protocols import (
    Coregionalised,
    Imputer,
    Prediction,
    SampleByFrameByChannel,
    Synthesiser,
)
from mocapbench.datasets import Frames, Recording

__all__ = ["GaussianProcess"]

Array = NDArray[np.float64]


class GaussianProcess(Imputer, Synthesiser, Coregionalised):
    """A linear model of coregionalisation, or two, trained by type-II maximum likelihood.

    Parameters
    ----------
    n_components : int or mapping of str to int, default=1
        Number Q of components of each layer, or of every layer by its name, such as
        ``{"parent": 3, "child": 1}``.
    rank : int, default=1
        Number of columns of each W_q; 0 makes the outputs independent.
    kernel : {"rbf", "matern12", "matern32", "matern52"}, default="matern32"
        The kernel of every component.
    n_restarts : int, default=1
        Number of searches; the first starts from the data, the others at random around it.
    max_iter : int, default=1000
        Largest number of iterations of a search.
    tol : float, default=1e-7
        A search has converged when an iteration gains less than this share of the log-likelihood
        of the recordings in standard units.
    max_seconds : float or None, default=None
        Time for all searches together; None sets no limit. When it is spent the best point so far
        is taken, and `training_` says so. Results then depend on the machine.
    warm_start : bool, default=False
        Whether `fit` starts from the parameters of the last one, where there was one.
    verbose : bool, default=False
        Whether `fit` prints a line for every iteration.
    solver : {"auto", "dense", "latent-split", "state-space", "kronecker"}, default="auto"
        How the likelihood is computed; "auto" takes the solver with the least counted work.
    sampled_trend : {"mean", "posterior"}, default="mean"
        The trend that `sample` draws new recordings around: its posterior mean, as in the thesis
        (§5.2), or one draw from its posterior, which all of a call's recordings share.
    n_jobs : int or None, default=None
        Number of threads over outputs, to which results owe nothing. None means 1, unless in a
        ``joblib.parallel_config`` context; −1 means all processors.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the random starts.

    Attributes
    ----------
    parameters_ : Parameters
        Maximum-likelihood parameters, for outputs in standard units.
    log_likelihood_ : float
        Log-likelihood of the recordings in their own units.
    bic_ : float
        Schwarz's criterion, −2 log L + k log n for k parameters and n visible entries, by which
        numbers of components may be chosen: lower is better.
    training_ : Training
        The searches, with their traces and messages; log-likelihoods there are those of the
        recordings in standard units.
    converged_, n_iterations_, n_evaluations_ : bool, int, int
        Those of the best search.
    solver_ : str
        The solvers that were used, such as "latent-split" or "dense+kronecker".
    engine_ : str
        The same, with their counted work and what every solver alone would have had.
    coregionalisation_ : dict of str to ndarray of shape (Q, D, D)
        The matrices B_q of each layer, in the outputs' own units.
    noise_ : ndarray of shape (D,)
        Noise variances, in the outputs' own units.
    """

    def __init__(
        self,
        *,
        n_components: int | Mapping[str, int] = 1,
        rank: int = 1,
        kernel: str = "matern32",
        n_restarts: int = 1,
        max_iter: int = 1000,
        tol: float = 1e-7,
        max_seconds: float | None = None,
        warm_start: bool = False,
        verbose: bool = False,
        solver: str = "auto",
        sampled_trend: str = "mean",
        n_jobs: int | None = None,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_components = n_components
        self.rank = rank
        self.kernel = kernel
        self.n_restarts = n_restarts
        self.max_iter = max_iter
        self.tol = tol
        self.max_seconds = max_seconds
        self.warm_start = warm_start
        self.verbose = verbose
        self.solver = solver
        self.sampled_trend = sampled_trend
        self.n_jobs = n_jobs
        self.random_state = random_state

    @abstractmethod
    def grow(self, names: Sequence[str]) -> Tree:
        """Return for each layer whose draw each of the recordings takes part in."""

    @abstractmethod
    def reduce(self, replicates: Replicates) -> Reduction:
        """Return the likelihood of replicates in standard units as block problems."""

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Find the parameters of largest likelihood.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, a name
            repeats, a channel is nowhere visible, or a warm start has other parameters.
        SingularCovarianceError
            If the covariance is singular at a start.
        """
        checked = check_recordings(recordings)
        self.tree_ = self.grow([recording.name for recording in checked])
        self._check_parameters()
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
        shares = [self._shares(recording) for recording in recordings]
        with self._at_work() as process:
            curves = process.infer(shares, [recording.times for recording in recordings])
        return [
            Prediction.around(recording, mean, variance + self.noise_)
            for recording, (mean, variance) in zip(recordings, curves, strict=True)
        ]

    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return draws around the trend, noise included.

        Each is the trend (see ``sampled_trend``), zero where a model has none, and draws of its
        own of the layers below, or of the only one. All of them cost one factorisation of the
        covariances.

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
        ValueError
            If the number of recordings is not a positive integer.
        """
        check_is_fitted(self)
        check_count("n_samples", n_samples, 1)
        rng = np.random.default_rng(random_state)
        times = np.asarray(times, dtype=np.float64)
        with self._at_work() as process:
            trend = TRENDS[self.sampled_trend](process, times, rng)
            layers = self.layers[1:] or self.layers
            return process.observe_new(layers, trend, times, n_samples, rng)

    def posterior_covariance(self, recording: Recording, times: Frames | None = None) -> Array:
        """Return the joint covariance of a recording's curve given all that is visible.

        Noise is left out: for observations add `noise_` to the diagonal.

        Parameters
        ----------
        recording : Recording
            One that `fit` has seen.
        times : ndarray of shape (M,), optional
            In seconds, in any order; the recording's own if left out.

        Returns
        -------
        ndarray of shape (D M, D M)
            In the outputs' own units; outputs are slowest, as in `covariance`. Symmetric, and
            positive semi-definite up to rounding. It takes memory for D M data vectors; for
            curves rather than their covariance, `posterior_draws` is cheaper.

        Raises
        ------
        ValueError
            If the recording was not given to `fit`, or not with these times and values.
        """
        check_is_fitted(self)
        curve, times = self._shares(recording), _or_own(times, recording)
        with self._at_work() as process:
            return process.joint_covariance(curve, times)

    def posterior_draws(
        self,
        recording: Recording,
        n_samples: int,
        random_state: int | np.random.Generator,
        times: Frames | None = None,
    ) -> SampleByFrameByChannel:
        """Return draws of a recording's curve given all that is visible.

        Noise is left out. Hidden and visible entries are drawn alike, as one function of time.

        Parameters
        ----------
        recording : Recording
            One that `fit` has seen.
        n_samples : int
            Number n of draws.
        random_state : int or numpy.random.Generator
            Seed of the draws; they do not depend on the solver, rounding aside.
        times : ndarray of shape (M,), optional
            In seconds, in any order; the recording's own if left out.

        Returns
        -------
        ndarray of shape (n, M, D)
            In the outputs' own units.

        Raises
        ------
        ValueError
            If the recording was not given to `fit`, or not with these times and values, or the
            number of draws is not a positive integer.
        """
        check_is_fitted(self)
        check_count("n_samples", n_samples, 1)
        curve, times = self._shares(recording), _or_own(times, recording)
        with self._at_work() as process:
            return process.draw(curve, times, n_samples, np.random.default_rng(random_state))

    def covariance(self, layer: str, times: Frames) -> Array:
        """Return Σ_q B_q ⊗ k_q of a layer in the outputs' own units, (D N, D N).

        Outputs are slowest, as in `ToyProcess`.
        """
        check_is_fitted(self)
        return self._process.prior_covariance(layer, np.asarray(times, dtype=np.float64))

    @property
    def layers(self) -> tuple[str, ...]:
        """The layers of the fitted model, from the trend down."""
        return tuple(self.tree_)

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
        start = self._start(replicates)
        rng = np.random.default_rng(self.random_state)
        others = [perturbed(start, rng) for _ in range(self.n_restarts - 1)]
        kernel = KERNELS[self.kernel]
        solvers = PLANS[self.solver](kernel, reduction, start)
        with mapping(effective_n_jobs(self.n_jobs)) as mapper:
            at_work = with_mapper(solvers, mapper)
            self.training_: Training = maximise(
                lambda parameters: reduction.evaluate(at_work, parameters),
                [start, *others],
                Space(Coordinates.around(start, self._draws), *bounds(start, replicates.times)),
                Budget(self.tol, self.max_iter, self.max_seconds),
                self._print if self.verbose else _say_nothing,
            )
        best = self.training_.best
        self.parameters_: Parameters = best.parameters
        self._process = FittedProcess(kernel, reduction, solvers, best.parameters, self.scaling_)
        self.log_likelihood_ = best.log_likelihood + self.scaling_.log_jacobian
        self.bic_ = best.parameters.flat.size * np.log(self.scaling_.counts.sum())
        self.bic_ -= 2.0 * self.log_likelihood_
        self.converged_, self.n_iterations_ = best.converged, best.n_iterations
        self.n_evaluations_, self.solver_ = best.n_evaluations, name_of(solvers)
        self.engine_ = reason(solvers, reduction, start)

    @contextmanager
    def _at_work(self) -> Iterator[FittedProcess]:
        """Give the fitted process with its threads running."""
        with mapping(effective_n_jobs(self.n_jobs)) as mapper:
            yield self._process.working_with(mapper)

    @property
    def _draws(self) -> Mapping[str, int]:
        """How many draws of each layer are behind the recordings."""
        return {layer: len(set(nodes)) for layer, nodes in self.tree_.items()}

    def _start(self, replicates: Replicates) -> Parameters:
        """Return where the first search begins."""
        start = data_driven(
            replicates,
            self.tree_,
            components_of(self.n_components, self.layers),
            self.rank,
            self.reduction_.within_variance,
        )
        if not (self.warm_start and hasattr(self, "parameters_")):
            return start
        if self.parameters_.shapes != start.shapes:
            raise ValueError(
                f"expected the parameters of the last fit to have the shapes {start.shapes} for a "
                f"warm start, got {self.parameters_.shapes}: set warm_start=False"
            )
        return self.parameters_

    def _print(self, search: int, step: Step) -> None:
        log_likelihood = step.log_likelihood + self.scaling_.log_jacobian
        print(
            f"search {search + 1} of {self.n_restarts}, iteration {step.iteration}: "
            f"log-likelihood {log_likelihood:.3f}, {step.seconds:.1f} s"
        )

    def _check_parameters(self) -> None:
        components_of(self.n_components, self.layers)
        for name, least in (("rank", 0), ("n_restarts", 1), ("max_iter", 1)):
            check_count(name, getattr(self, name), least)
        check_positive("tol", self.tol)
        if self.max_seconds is not None:
            check_positive("max_seconds", self.max_seconds)
        check_jobs(self.n_jobs)
        check_choice("kernel", self.kernel, KERNELS)
        check_choice("solver", self.solver, PLANS)
        check_choice("sampled_trend", self.sampled_trend, TRENDS)

    def _shares(self, recording: Recording) -> tuple[Share, ...]:
        """Return the shares of a recording that `fit` has seen."""
        self._check_seen(recording)
        return self.reduction_.replicates[list(self.recordings_).index(recording.name)]

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


def _say_nothing(search: int, step: Step) -> None:
    """Report no step."""


def _or_own(times: Frames | None, recording: Recording) -> Frames:
    """Return ``times``, or the recording's own."""
    return recording.times if times is None else np.asarray(times, dtype=np.float64)
