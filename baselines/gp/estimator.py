"""The one estimator of the Gaussian-process models: training by maximum likelihood, prediction.

`GaussianProcess.fit` is in four steps: recordings become a small problem (`reduction`), a search
starts from the data and finds parameters (`training`), and the result is a `FittedProcess`. All
that a model predicts or draws is what that process says.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import ClassVar, Self

import numpy as np
from joblib import effective_n_jobs
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_given, check_recordings
from mocapbench.baselines.common.recordings import by_content
from mocapbench.baselines.common.scaling import Standardisation
from mocapbench.baselines.common.validation import (
    check_choice,
    check_count,
    check_flag,
    check_jobs,
    check_positive,
    check_sampling,
    check_seed,
    check_times,
    components_of,
)
from mocapbench.baselines.gp.leave_one_out import leave_one_out_ratios
from mocapbench.baselines.gp.prior.kernels import KERNELS
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.process import TRENDS, Curve, FittedProcess
from mocapbench.baselines.gp.reduction.reduction import Reduction, Replicates
from mocapbench.baselines.gp.reduction.tree import Tree
from mocapbench.baselines.gp.solvers.planner import (
    PLANS,
    describe_work,
    solver_names,
    with_mapper,
)
from mocapbench.baselines.gp.solvers.solver import Solver, thread_mapper
from mocapbench.baselines.gp.training.coordinates import Coordinates
from mocapbench.baselines.gp.training.maximum_likelihood import (
    Budget,
    Search,
    maximise,
)
from mocapbench.baselines.gp.training.start import start_from_data, vary_start
from mocapbench.baselines.protocols import (
    Coregionalised,
    Imputer,
    Prediction,
    SampleByFrameByChannel,
    Synthesiser,
)
from mocapbench.basics.arrays import Array
from mocapbench.datasets import FrameByChannel, Frames, Recording

__all__ = ["GaussianProcess"]


@dataclass(kw_only=True, eq=False, repr=False)
class GaussianProcess(Imputer, Synthesiser, Coregionalised):
    """A linear model of coregionalisation, or several layers of them.

    Trained by type-II maximum likelihood on all recordings together. N is the number of frames of
    a recording, D that of outputs (channels), Q that of components of a layer.

    Parameters
    ----------
    n_components : int or mapping of str to int, default=1
        Number Q of components of every layer, or of each layer by its name, such as
        ``{"parent": 3, "child": 1}``.
    rank : int, default=1
        Number of columns of each factor W_q; 0 makes the outputs independent.
    kernel : {"rbf", "matern12", "matern32", "matern52"}, default="matern32"
        The kernel of every component.
    n_restarts : int, default=1, or 5 for MOHGP
        Number of searches. The first starts from the data, the next four with its lengthscales
        assigned otherwise, the others at random around it. Of starts that are the same, as with one
        component, one is searched.
    max_iter : int, default=1000
        Largest number of iterations of a search.
    tol : float, default=1e-7
        A search has converged when an iteration gains less than this fraction of the
        log-likelihood of the recordings in standard units.
    max_seconds : float or None, default=None
        Time limit for all searches together; None sets no limit. When it is spent, the best
        parameters so far are taken, and ``training_`` says so. Results then depend on the machine.
        An evaluation of the likelihood that has begun is finished first: with "rbf" it takes time
        with the cube of the frames, with Matérn kernels in proportion to them.
    warm_start : bool, default=False
        Whether `fit` starts from the parameters of the previous one, if there was one.
    verbose : bool, default=False
        Whether `fit` prints a line for every iteration.
    solver : {"auto", "dense", "latent-split", "state-space", "kronecker"}, default="auto"
        How the likelihood is computed; "auto" takes the solver with the least estimated work for
        each part of the problem. All solvers are exact.
    sampled_trend : {"mean", "posterior"}, default="mean"
        The trend around which `sample` draws new recordings: its posterior mean, as in §5.2 of the
        thesis of J. D. Gil López (2017), or one draw from its posterior, shared by all recordings
        of a call. A model without a trend does not use it.
    n_jobs : int or None, default=None
        Number of threads over outputs; it does not affect results. None means 1, unless in a
        ``joblib.parallel_config`` context; −1 means all processors.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the random starts.

    Attributes
    ----------
    channels_, units_ : tuple of D str
        The channels of the recordings given to `fit`, and their units.
    process_ : FittedProcess
        The process with its parameters, given the recordings.
    parameters_ : Parameters
        Maximum-likelihood parameters, for outputs in standard units.
    log_likelihood_ : float
        Log-likelihood of the recordings in their own units.
    bic_ : float
        Schwarz's criterion, −2 log L + k log n for k parameters and n visible entries, by which
        numbers of components may be chosen: lower is better.
    training_ : tuple of Search
        The searches, with the log-likelihood after each iteration, of the recordings in standard
        units.
    converged_, n_iterations_, n_evaluations_ : bool, int, int
        Those of the best search.
    solver_, engine_ : str
        The solvers that were used, such as "dense+kronecker", without and with their estimated
        work and that of every solver alone.
    coregionalisation_ : dict of str to ndarray of shape (Q, D, D)
        The matrices B_q of each layer, in the outputs' own units.
    noise_ : ndarray of shape (D,)
        Noise variances, in the outputs' own units.
    """

    family: ClassVar[str] = "Gaussian processes"
    provides: ClassVar[frozenset[str]] = (
        Imputer.provides | Synthesiser.provides | Coregionalised.provides | {"scales along"}
    )
    max_frames: ClassVar[int | None] = 200

    n_components: int | Mapping[str, int] = 1
    rank: int = 1
    kernel: str = "matern32"
    n_restarts: int = 1
    max_iter: int = 1000
    tol: float = 1e-7
    max_seconds: float | None = None
    warm_start: bool = False
    verbose: bool = False
    solver: str = "auto"
    sampled_trend: str = "mean"
    n_jobs: int | None = None
    random_state: int | np.random.Generator | None = None

    @abstractmethod
    def grow(self, names: Sequence[str]) -> Tree:
        """Return for each layer the node of each of the recordings with these names."""

    @abstractmethod
    def reduce(self, replicates: Replicates) -> Reduction:
        """Return the likelihood of replicates in standard units as block problems."""

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Find the parameters of largest likelihood.

        Parameters
        ----------
        recordings : sequence of Recording
            Recordings with the same channels and different names; NaN marks a hidden entry. Times
            may differ and be irregular.

        Returns
        -------
        GaussianProcess
            The model itself.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, a name
            repeats, a channel is nowhere visible, or a warm start has parameters of other shapes.
        SingularCovarianceError
            If the covariance is singular at a start.
        """
        checked = by_content(check_recordings(recordings))
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        self.tree_: Tree = self.grow([recording.name for recording in checked])
        self._check_parameters()
        self.scaling_: Standardisation = Standardisation.of(checked)
        self.recordings_: dict[str, Recording] = {
            recording.name: recording for recording in checked
        }
        self._replicates = Replicates.align([self.scaling_.apply(each) for each in checked])
        self._learn(self.reduce(self._replicates))
        return self

    def _learn(self, reduction: Reduction) -> None:
        """Find the parameters, and set the attributes that follow from them."""
        kernel, start = KERNELS[self.kernel], self._start(reduction)
        solvers = PLANS[self.solver](kernel, reduction.blocks, start)
        self.training_: tuple[Search, ...] = self._search(reduction, solvers, start)
        best = max(self.training_, key=lambda search: search.log_likelihood)
        self.process_: FittedProcess = FittedProcess(
            kernel, reduction, solvers, best.parameters, self.scaling_
        )
        self.solver_: str = solver_names(solvers)
        self.engine_: str = describe_work(solvers, reduction.blocks, start)
        self.parameters_: Parameters = best.parameters
        self.log_likelihood_: float = best.log_likelihood + self.scaling_.log_jacobian
        complexity = best.parameters.flat.size * np.log(self.scaling_.counts.sum())
        self.bic_: float = complexity - 2.0 * self.log_likelihood_
        self.converged_: bool = best.converged
        self.n_iterations_: int = best.n_iterations
        self.n_evaluations_: int = best.n_evaluations

    def _search(
        self, reduction: Reduction, solvers: Sequence[Solver], start: Parameters
    ) -> tuple[Search, ...]:
        begin = vary_start(start, self.n_restarts, np.random.default_rng(self.random_state))
        draws = {layer: len(set(nodes)) for layer, nodes in self.tree_.items()}
        coordinates = Coordinates.around(start, draws, self._replicates.times)
        with thread_mapper(effective_n_jobs(self.n_jobs)) as mapper:
            return maximise(
                partial(reduction.evaluate, with_mapper(solvers, mapper)),
                begin,
                coordinates,
                Budget(self.tol, self.max_iter, self.max_seconds),
                partial(self._print, len(begin)) if self.verbose else _report_nothing,
            )

    def _start(self, reduction: Reduction) -> Parameters:
        """Return the parameters from which the first search starts."""
        sizes = components_of(self.n_components, self.layers)
        within = reduction.within_variance
        start = start_from_data(self._replicates, self.tree_, sizes, self.rank, within)
        if not (self.warm_start and hasattr(self, "parameters_")):
            return start
        if self.parameters_.shapes != start.shapes:
            raise ValueError(
                f"expected the parameters of the last fit to have the shapes {start.shapes} for a "
                f"warm start, got {self.parameters_.shapes}: set warm_start=False"
            )
        return self.parameters_

    def _print(
        self, n_searches: int, search: int, iteration: int, log_likelihood: float, seconds: float
    ) -> None:
        of_data = log_likelihood + self.scaling_.log_jacobian
        print(
            f"search {search + 1} of {n_searches}, iteration {iteration}: "
            f"log-likelihood {of_data:.3f}, {seconds:.1f} s"
        )

    def _check_parameters(self) -> None:
        components_of(self.n_components, self.layers)
        for name, least in (("rank", 0), ("n_restarts", 1), ("max_iter", 1)):
            check_count(name, getattr(self, name), least)
        check_positive("tol", self.tol)
        if self.max_seconds is not None:
            check_positive("max_seconds", self.max_seconds)
        for name in ("warm_start", "verbose"):
            check_flag(name, getattr(self, name))
        check_jobs(self.n_jobs)
        check_seed("random_state", self.random_state)
        check_choice("kernel", self.kernel, KERNELS)
        check_choice("solver", self.solver, PLANS)
        check_choice("sampled_trend", self.sampled_trend, TRENDS)

    @property
    def layers(self) -> tuple[str, ...]:
        """The layers of the fitted model, from the trend down, such as ("parent", "child")."""
        check_is_fitted(self, "tree_")
        return tuple(self.tree_)

    @property
    def coregionalisation_(self) -> Mapping[str, Array]:
        """The matrices B_q of each layer by its name, (Q, D, D), in the outputs' own units.

        Entry (d, e) of B_q is in the unit of output d times that of output e.
        """
        check_is_fitted(self, "process_")
        return self.process_.coregionalisation

    @property
    def noise_(self) -> Array:
        """(D,) noise variance of each output, in the output's squared unit."""
        check_is_fitted(self, "process_")
        return self.process_.noise

    def covariance(self, layer: str, times: Frames) -> Array:
        """Return the prior covariance Σ_q B_q ⊗ k_q of a layer.

        Parameters
        ----------
        layer : str
            One of `layers`.
        times : ndarray of shape (N,)
            In seconds, in any order.

        Returns
        -------
        ndarray of shape (D N, D N)
            In the outputs' own units. Outputs are slowest, as in `ToyProcess`: entry
            (d N + i, e N + j) is the covariance of output d at time i with output e at time j.

        Raises
        ------
        sklearn.exceptions.NotFittedError
            If `fit` has not been called.
        ValueError
            If the model has no such layer, or times are not finite numbers.
        """
        check_is_fitted(self)
        check_choice("layer", layer, self.layers)
        return self.process_.layer_covariance(layer, check_times(times))

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the posterior of recordings given to `fit`.

        Each is conditioned on the visible entries of *all* recordings given to `fit`.

        Parameters
        ----------
        recordings : sequence of Recording
            Recordings given to `fit`, in any order, with the same names, times and values.

        Returns
        -------
        list of Prediction
            One for each recording, with a mean and a variance of shape (N, D) in the channels' own
            units and their squares. Variances include the noise. Visible entries are copied, with
            variance 0.

        Raises
        ------
        sklearn.exceptions.NotFittedError
            If `fit` has not been called.
        ValueError
            If a recording was not given to `fit`, or not with these times and values.
        """
        return [
            self._predict(recording, mean, variance)
            for recording, mean, variance in self._infer_recordings(recordings)
        ]

    def leave_one_out(self, recordings: Sequence[Recording]) -> list[tuple[Prediction, Array]]:
        """Return the posterior of recordings, and the errors of visible entries left out: (N, D).

        These are squared errors over variances. An entry is predicted from all others, with the
        parameters kept; NaN marks hidden ones. It raises what `impute` raises. Errors of a
        recording that registration has moved mean nothing.
        """
        return [
            (
                self._predict(recording, mean, variance),
                leave_one_out_ratios(recording, mean, variance, self.noise_, self.scaling_.scale),
            )
            for recording, mean, variance in self._infer_recordings(recordings)
        ]

    def _predict(
        self, recording: Recording, mean: FrameByChannel, variance: FrameByChannel
    ) -> Prediction:
        """Return the prediction of observations, from that of the noise-free curve."""
        return Prediction.around(recording, mean, variance + self.noise_)

    def impute_held_out(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the posterior of recordings given to `fit` of which more is hidden.

        The parameters are kept. That of a recording that registration has moved means nothing.
        """
        check_given(self, recordings)
        return [self._condition_on(recording) for recording in recordings]

    def _infer_recordings(
        self, recordings: Sequence[Recording]
    ) -> Iterator[tuple[Recording, FrameByChannel, FrameByChannel]]:
        """Yield recordings given to `fit`, with the posterior means and variances of their curves.

        All of them together take one inference.
        """
        check_given(self, recordings)
        curves = [self._curve(recording) for recording in recordings]
        with self.process_.threaded(self.n_jobs) as process:
            inferred = process.infer(curves, [recording.times for recording in recordings])
        for recording, (mean, variance) in zip(recordings, inferred, strict=True):
            yield recording, mean, variance

    def _condition_on(self, shown: Recording) -> Prediction:
        """Return the posterior where ``shown`` takes the place of the recording of its name."""
        if shown.visible.all():
            return Prediction.around(shown, shown.values, np.zeros_like(shown.values))
        number = self._number(shown)
        conditioned = self.process_.condition(self.reduce(self._replicates.showing(number, shown)))
        with conditioned.threaded(self.n_jobs) as process:
            curve = process.reduction.replicates[number]
            ((mean, variance),) = process.infer([curve], [shown.times])
        return self._predict(shown, mean, variance)

    def _infer_curve(self, curve: Curve, times: Frames) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the posterior mean and variance of a curve, such as the trend: (M, D) each."""
        with self.process_.threaded(self.n_jobs) as process:
            (inferred,) = process.infer([curve], [check_times(times)])
        return inferred

    def posterior_covariance(self, recording: Recording, times: Frames | None = None) -> Array:
        """Return the joint covariance of a recording's curve given all visible entries.

        Noise is left out: for observations add `noise_` to the diagonal.

        Parameters
        ----------
        recording : Recording
            One that was given to `fit`.
        times : ndarray of shape (M,), optional
            In seconds, in any order; the recording's times if left out.

        Returns
        -------
        ndarray of shape (D M, D M)
            In the outputs' own units; outputs are slowest, as in `covariance`. Symmetric, and
            positive semi-definite up to rounding. It takes memory for D M data vectors; if only
            draws of the curve are needed, `posterior_draws` is cheaper.

        Raises
        ------
        sklearn.exceptions.NotFittedError
            If `fit` has not been called.
        ValueError
            If the recording was not given to `fit`, or not with these times and values.
        """
        check_given(self, [recording])
        curve, times = self._curve(recording), self._process_times(recording, times)
        with self.process_.threaded(self.n_jobs) as process:
            return process.covariance(curve, times)

    def posterior_draws(
        self,
        recording: Recording,
        n_samples: int,
        random_state: int | np.random.Generator,
        times: Frames | None = None,
    ) -> SampleByFrameByChannel:
        """Return draws of a recording's curve given all visible entries.

        Noise is left out. A draw is one function of time, at hidden and at visible entries.

        Parameters
        ----------
        recording : Recording
            One that was given to `fit`.
        n_samples : int
            Number n of draws.
        random_state : int or numpy.random.Generator
            Seed of the draws; rounding aside, they do not depend on the solver.
        times : ndarray of shape (M,), optional
            In seconds, in any order; the recording's times if left out.

        Returns
        -------
        ndarray of shape (n, M, D)
            In the outputs' own units.

        Raises
        ------
        sklearn.exceptions.NotFittedError
            If `fit` has not been called.
        ValueError
            If the recording was not given to `fit`, or not with these times and values, or the
            number of draws or the seed is invalid.
        """
        check_given(self, [recording])
        check_count("n_samples", n_samples, 1)
        check_seed("random_state", random_state)
        curve, times = self._curve(recording), self._process_times(recording, times)
        with self.process_.threaded(self.n_jobs) as process:
            return process.draw(curve, times, n_samples, np.random.default_rng(random_state))

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
        with self.process_.threaded(self.n_jobs) as process:
            return process.draw_recordings(self.sampled_trend, times, n_samples, rng)

    def _process_times(self, recording: Recording, times: Frames | None) -> Frames:
        """Return the times of the process at which a recording has ``times``, or its own."""
        return recording.times if times is None else check_times(times)

    def _curve(self, recording: Recording) -> Curve:
        """Return the curve of a recording, which has to be as it was given to `fit`."""
        number, fitted = self._number(recording), self.recordings_[recording.name]
        same = np.array_equal(fitted.times, recording.times) and np.array_equal(
            fitted.values, recording.values, equal_nan=True
        )
        if not same:
            raise ValueError(
                f"recording {recording.name!r} differs from the one of that name given to fit: "
                "expected the same times, visible values and hidden entries; fit again"
            )
        return self.process_.reduction.replicates[number]

    def _number(self, recording: Recording) -> int:
        """Return the place among the recordings given to `fit` of the one of that name."""
        if recording.name not in self.recordings_:
            raise ValueError(
                f"expected recordings that were given to fit, {sorted(self.recordings_)}, got "
                f"{recording.name!r}: give it to fit together with the others"
            )
        return list(self.recordings_).index(recording.name)


def _report_nothing(*iteration: float) -> None:
    """Report no iteration."""
