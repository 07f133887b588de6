"""The base class of the Gaussian-process models: training by maximum likelihood."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import ClassVar, Self

import numpy as np
from joblib import effective_n_jobs

from mocapbench.baselines.common.checks import check_recordings
from mocapbench.baselines.common.scaling import Standardisation
from mocapbench.baselines.common.validation import (
    check_choice,
    check_count,
    check_flag,
    check_jobs,
    check_positive,
    check_seed,
    components_of,
)
from mocapbench.baselines.gp.imputation import RecordingPosterior
from mocapbench.baselines.gp.planner import PLANS, describe_work, solver_names, with_mapper
from mocapbench.baselines.gp.posterior.fitted import FittedProcess
from mocapbench.baselines.gp.posterior.trends import TRENDS
from mocapbench.baselines.gp.prior.kernels import KERNELS
from mocapbench.baselines.gp.prior.parameters import Parameters
from mocapbench.baselines.gp.reduction.reduction import Reduction
from mocapbench.baselines.gp.reduction.replicates import Replicates
from mocapbench.baselines.gp.reduction.tree import Tree
from mocapbench.baselines.gp.synthesis import NewRecordings
from mocapbench.baselines.gp.threads import thread_mapper
from mocapbench.baselines.gp.training.bounds import bounds
from mocapbench.baselines.gp.training.coordinates import Coordinates
from mocapbench.baselines.gp.training.maximum_likelihood import maximise
from mocapbench.baselines.gp.training.search import Budget, Iteration, SearchSpace, Training
from mocapbench.baselines.gp.training.start import data_driven, starts
from mocapbench.datasets import Recording

__all__ = ["GaussianProcess"]


class GaussianProcess(RecordingPosterior, NewRecordings):
    """A linear model of coregionalisation, or several layers of them.

    Trained by type-II maximum likelihood on all recordings together. N is the number of frames of
    a recording, D that of outputs (channels), Q that of components of a layer.

    Parameters
    ----------
    n_components : int or mapping of str to int, default=1
        Number Q of components of every layer, or of each layer by its name, such as
        ``{"parent": 3, "child": 1}``.
    rank : int, default=1
        Number of columns of each W_q; 0 makes the outputs independent.
    kernel : {"rbf", "matern12", "matern32", "matern52"}, default="matern32"
        The kernel of every component.
    n_restarts : int, default=1
        Number of searches. The first starts from the data, the next four with its lengthscales
        assigned otherwise, the others at random around it. Of starts that are the same, as with one
        component, one is searched.
    max_iter : int, default=1000
        Largest number of iterations of a search.
    tol : float, default=1e-7
        A search has converged when an iteration gains less than this fraction of the
        log-likelihood of the recordings in standard units.
    max_seconds : float or None, default=None
        Time for all searches together, in seconds; None sets no limit. When it is spent the best
        parameters so far are taken, and `training_` says so. Results then depend on the machine.
    warm_start : bool, default=False
        Whether `fit` starts from the parameters of the previous fit, if there was one.
    verbose : bool, default=False
        Whether `fit` prints a line for every iteration.
    solver : {"auto", "dense", "latent-split", "state-space", "kronecker"}, default="auto"
        How the likelihood is computed; "auto" takes the solver with the least estimated work for
        each block. All solvers are exact.
    sampled_trend : {"mean", "posterior"}, default="mean"
        The trend that `sample` draws new recordings around: its posterior mean, as in §5.2 of the
        thesis (J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion
        Data*, MSc thesis, Universidad Tecnológica de Pereira, 2017), or one draw from its
        posterior, which all recordings of a call share.
    n_jobs : int or None, default=None
        Number of threads over outputs; it does not affect results. None means 1, unless in a
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
        The same, with their estimated work and that of every solver alone.
    coregionalisation_ : dict of str to ndarray of shape (Q, D, D)
        The matrices B_q of each layer, in the outputs' own units.
    noise_ : ndarray of shape (D,)
        Noise variances, in the outputs' own units.
    """

    family: ClassVar[str] = "Gaussian processes"
    _replicates: Replicates

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
        checked = check_recordings(recordings)
        self.channels_, self.units_ = checked[0].channels, checked[0].units
        self.tree_ = self.grow([recording.name for recording in checked])
        self._check_parameters()
        self.scaling_ = Standardisation.of(checked)
        self.recordings_ = {recording.name: recording for recording in checked}
        aligned = [self.scaling_.apply(recording) for recording in checked]
        self._replicates = Replicates.align(aligned)
        self.reduction_ = self.reduce(self._replicates)
        self._train(self._replicates)
        return self

    def _showing(self, number: int, trial: Recording) -> FittedProcess:
        fitted, reduction = self._process, self.reduce(self._replicates.showing(number, trial))
        # A trial may break what the solver of `fit` needs, such as gaps that all outputs share.
        solvers = PLANS["auto"](fitted.kernel, reduction, fitted.parameters)
        return replace(fitted, reduction=reduction, solvers=solvers)

    def _train(self, replicates: Replicates) -> None:
        reduction = self.reduction_
        start = self._start(replicates)
        begin = starts(start, self.n_restarts, np.random.default_rng(self.random_state))
        kernel = KERNELS[self.kernel]
        solvers = PLANS[self.solver](kernel, reduction, start)
        draws = {layer: len(set(nodes)) for layer, nodes in self.tree_.items()}
        space = SearchSpace(Coordinates.around(start, draws), *bounds(start, replicates.times))
        with thread_mapper(effective_n_jobs(self.n_jobs)) as mapper:
            threaded = with_mapper(solvers, mapper)
            self.training_: Training = maximise(
                lambda parameters: reduction.evaluate(threaded, parameters),
                begin,
                space,
                Budget(self.tol, self.max_iter, self.max_seconds),
                partial(self._print, len(begin)) if self.verbose else _report_nothing,
            )
        self.solver_ = solver_names(solvers)
        self.engine_ = describe_work(solvers, reduction, start)
        best = self.training_.best.parameters
        self._process = FittedProcess(kernel, reduction, solvers, best, self.scaling_)
        self._summarise()

    def _summarise(self) -> None:
        """Set the attributes that are those of the best search."""
        best = self.training_.best
        self.parameters_ = best.parameters
        self.log_likelihood_ = best.log_likelihood + self.scaling_.log_jacobian
        self.bic_ = best.parameters.flat.size * np.log(self.scaling_.counts.sum())
        self.bic_ -= 2.0 * self.log_likelihood_
        self.converged_, self.n_iterations_ = best.converged, best.n_iterations
        self.n_evaluations_ = best.n_evaluations

    def _start(self, replicates: Replicates) -> Parameters:
        """Return the parameters from which the first search starts."""
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

    def _print(self, n_searches: int, search: int, step: Iteration) -> None:
        log_likelihood = step.log_likelihood + self.scaling_.log_jacobian
        print(
            f"search {search + 1} of {n_searches}, iteration {step.iteration}: "
            f"log-likelihood {log_likelihood:.3f}, {step.seconds:.1f} s"
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


def _report_nothing(search: int, step: Iteration) -> None:
    """Report no iteration."""
