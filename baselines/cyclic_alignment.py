"""Styles of cyclic motion, clustered and aligned without labels.

The model is that of W. Pan and L. Torresani (2009), *Unsupervised Hierarchical Modeling of
Locomotion Styles*, ICML, cited as HLM.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.alignment.aligner import CycleAligner
from mocapbench.baselines.alignment.cycle_model import Hyperparameters, State, entry_moments
from mocapbench.baselines.alignment.inference import correct_means, refine_state
from mocapbench.baselines.alignment.new_motion import blend_cycles, draw_sequences
from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.alignment.restarts import run_from_random_start
from mocapbench.baselines.common.ascent import Ascent
from mocapbench.baselines.common.checks import check_given
from mocapbench.baselines.common.validation import (
    check_sampling,
)
from mocapbench.baselines.protocols import (
    Blender,
    Imputer,
    Inductive,
    Prediction,
    SampleByFrameByChannel,
    Synthesiser,
)
from mocapbench.basics.arrays import Array
from mocapbench.basics.numbers import real_numbers
from mocapbench.datasets import FrameByChannel, Frames, Recording

__all__ = ["CyclicAlignment"]


class CyclicAlignment(CycleAligner, Imputer, Inductive, Blender, Synthesiser):
    r"""A cycle for each style around a common cycle, warped in time to fit each recording.

    Each recording has one style. Its frames follow that style's cycle of M states through a cyclic
    left-to-right Markov chain, which advances by 1 to J states a frame. The noise has one variance
    for each style and channel. The styles' cycles are smooth Gaussian deviations from a common
    parent cycle. Hidden entries are integrated out. The model works on channels of zero mean and
    unit variance.

    Parameters
    ----------
    n_styles : int, default=20
        Number C of styles; EM may leave some of them empty.
    n_states : int or None, default=None
        Number M of states of a cycle, at least ``2 * max_jump + 1``. None means two for each frame
        of a cycle, whose length is estimated by autocorrelation.
    max_jump : int, default=3
        Largest number J of states between consecutive frames.
    n_restarts : int, default=3
        Number of runs of EM from random starts. The one with the highest bound is kept, but
        `impute` averages over all.
    max_iter : int, default=40
        Largest number of iterations of a run.
    tol : float, default=1e-5
        A run has converged when an iteration raises the bound by less than ``tol`` per
        visible entry.
    n_inner : int, default=3
        Sweeps of the E-step in an iteration.
    regularisation : float, default=0.1
        Weight :math:`\eta` of the penalty on the parent's squared steps and of the Dirichlet priors
        of styles and jumps.
    closeness : float, default=0.01
        Precision :math:`\lambda_{\bar z}` of a cycle about its parent; the initial value if it is
        learnt.
    learn_closeness : bool, default=False
        Whether :math:`\lambda_{\bar z}` is learnt; the paper keeps it fixed.
    smoothness : float, default=0.1
        Initial precision :math:`\lambda_s` of a cycle's steps; it is learnt.
    prior : {"normalised", "centred", "paper"}, default="normalised"
        The prior of a cycle: HLM's with the normaliser of a Gaussian; one whose deviations from the
        parent are smooth; or HLM's as printed, which is not normalised.
    grouping : {"random", "similar"}, default="random"
        The first styles: random groups of equal size, which vary more between runs and so gain more
        from averaging, or groups of recordings that are alike in shape and tempo once aligned to a
        common cycle, which EM keeps, for finding styles.
    refine_iter : int, default=10
        Iterations of EM, continued from `fit`, that `impute` runs on a recording together with the
        fitted ones.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the starts.

    Attributes
    ----------
    labels_ : ndarray of int, shape (K,)
        The most likely style of each recording.
    path_ : tuple of ndarray of int, each of shape (N_k,)
        The most likely state sequence of each recording (Viterbi).
    cycle_length_ : int
        Number M of states.
    cycles_ : ndarray of shape (C, M, D)
        Mean cycle of each style, in the channels' units.
    probabilities_ : ndarray of shape (K, C)
        Probability of each style for each recording.
    bound_ : ndarray of shape (n_iterations + 1,)
        The variational bound at the start and after each iteration, for standardised channels.
    runs_ : list of Ascent
        All runs of EM.
    restart_bounds_ : ndarray of shape (n_restarts,)
        The final bound of each run.
    n_iterations_ : int
        Iterations of the run that was kept.
    converged_ : bool
        Whether that run converged.

    Notes
    -----
    With the cycle :math:`z^c` of style c and its parent :math:`\bar z`, states counted modulo M,
    and the state :math:`\pi_i` and the channel f of frame i of a recording of style c:

    .. math::

        p(z^c) \propto \exp\Bigl(-\tfrac12 \lambda_s \sum_m (z_m - z_{m-1})^2
        - \tfrac12 \lambda_{\bar z} \sum_m (z_m - \bar z_m)^2\Bigr)

    .. math::

        p(\pi_i = m \mid \pi_{i-1} = m - j) = d_j, \quad j = 1 \ldots J, \qquad
        x_{if} \sim N(z^c_{\pi_i f}, 1 / \lambda^c_f)

    ``docs/mathematics/alignment.md`` has the algorithm.

    References
    ----------
    W. Pan and L. Torresani (2009), Unsupervised Hierarchical Modeling of Locomotion Styles, ICML:
    the model §2, variational EM §3, blending §4.2, missing data §4.3.
    ``docs/mathematics/alignment.md`` lists the corrections to its formulas.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import CyclicAlignment
    >>> from mocapbench.datasets import Recording
    >>> def walk(name, n_frames, period):
    ...     angle = 2 * np.pi * np.arange(n_frames) / period
    ...     values = np.column_stack([np.sin(angle), np.cos(angle)])
    ...     return Recording(name, np.arange(n_frames) / 30, values, ("hip", "knee"), ("deg",) * 2)
    >>> walks = [walk("slow", 40, 10), walk("fast", 30, 8)]
    >>> model = CyclicAlignment(n_styles=2, n_states=16, n_restarts=1, random_state=0).fit(walks)
    >>> model.cycles_.shape, bool((np.diff(model.bound_) >= -1e-6).all())
    ((2, 16, 2), True)
    >>> hidden = np.zeros((30, 2), dtype=bool)
    >>> hidden[10:15, 0] = True
    >>> (prediction,) = model.impute([walks[1].hide(hidden)])
    >>> bool(np.abs(prediction.mean - walks[1].values).max() < 0.5)
    True
    """

    provides: ClassVar[frozenset[str]] = (
        CycleAligner.provides
        | Imputer.provides
        | Inductive.provides
        | Blender.provides
        | Synthesiser.provides
        | {"scales along"}
    )
    max_frames: ClassVar[int | None] = 500

    def __init__(
        self,
        *,
        n_styles: int = 20,
        n_states: int | None = None,
        max_jump: int = 3,
        n_restarts: int = 3,
        max_iter: int = 40,
        tol: float = 1e-5,
        n_inner: int = 3,
        regularisation: float = 0.1,
        closeness: float = 0.01,
        learn_closeness: bool = False,
        smoothness: float = 0.1,
        prior: str = "normalised",
        grouping: str = "random",
        refine_iter: int = 10,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_styles = n_styles
        self.n_states = n_states
        self.max_jump = max_jump
        self.n_restarts = n_restarts
        self.max_iter = max_iter
        self.tol = tol
        self.n_inner = n_inner
        self.regularisation = regularisation
        self.closeness = closeness
        self.learn_closeness = learn_closeness
        self.smoothness = smoothness
        self.prior = prior
        self.grouping = grouping
        self.refine_iter = refine_iter
        self.random_state = random_state

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return mean and variance of the mixture over styles and states at hidden entries.

        A recording joins the fitted ones, replacing one of the same name, for ``refine_iter``
        iterations of EM. These start from the style with the highest bound and, if a style is
        empty, also from a new style for this recording alone; the run with the higher bound is
        kept. The errors of a frame's visible entries then correct its hidden ones, by the
        covariance of the errors of all recordings. The result is the mixture over all runs of
        `fit`, with equal weights: the bound does not rank their errors.

        Raises
        ------
        ValueError
            If channels differ.
        """
        check_given(self, recordings)
        states = [run.state for run in self.runs_]
        return [self._mixture(recording, states) for recording in recordings]

    def impute_held_out(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return what the run with the highest bound predicts, at a share of the cost of all."""
        check_given(self, recordings)
        return [self._mixture(recording, [self.state_]) for recording in recordings]

    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Draw recordings at the frame rate of the fitted ones, noise included: (n, N, D).

        Each has the style and the pace of a random fitted recording, and a new cycle of that style.
        Of ``times`` (N,) only the number counts.

        Raises
        ------
        ValueError
            If times do not increase, or the number of samples or the seed is invalid.
        """
        check_is_fitted(self)
        times = check_sampling(times, n_samples, random_state)
        rng = np.random.default_rng(random_state)
        return self._restore_units(draw_sequences(self.state_, n_samples, len(times), rng))

    def blend(self, weights: ArrayLike) -> FrameByChannel:
        """Return the styles' mean cycles mixed by weights (N, C) that vary from frame to frame.

        HLM §4.2. The frames start at state 0 and advance at the mean pace of the fitted recordings.

        Raises
        ------
        ValueError
            If the weights are not (N, n_styles), are negative, or a row's sum is not 1.
        """
        check_is_fitted(self)
        return self._restore_units(blend_cycles(self.state_, real_numbers("weights", weights)))

    def _hyperparameters(self) -> Hyperparameters:
        return Hyperparameters(
            self.regularisation,
            PRIORS[self.prior],
            closeness=self.closeness,
            smoothness=self.smoothness,
            learn_closeness=self.learn_closeness,
            max_jump=self.max_jump,
            n_styles=self.n_styles,
            grouping=self.grouping,
            n_inner=self.n_inner,
            tol=self.tol,
        )

    def _learn(self, rng: np.random.Generator) -> Ascent[State]:
        self.runs_: list[Ascent[State]] = [
            run_from_random_start(
                self.sequences_, self.cycle_length_, self.hyper_, self.max_iter, rng
            )
            for _ in range(self.n_restarts)
        ]
        self.restart_bounds_: Array = np.array([run.objectives[-1] for run in self.runs_])
        return self.runs_[int(self.restart_bounds_.argmax())]

    def _describe(self, run: Ascent[State], places: NDArray[np.intp]) -> None:
        self.bound_: Array = np.array(run.objectives)
        self.cycles_: Array = self._restore_units(run.state.cycles.mean.swapaxes(0, 1))
        self.probabilities_: Array = run.state.labels[places]
        self.labels_: NDArray[np.intp] = self.probabilities_.argmax(axis=1)

    def _mixture(self, recording: Recording, states: Sequence[State]) -> Prediction:
        """Return the mean and variance of the mixture over fitted states, with equal weights."""
        members = np.array([self._fill_by_run(recording, state) for state in states])
        filled, spread = members.swapaxes(0, 1)
        mean = filled.mean(axis=0)
        variance = spread.mean(axis=0) + filled.var(axis=0)
        return Prediction.around(
            recording, self._restore_units(mean), variance * self.scaling_.scale**2
        )

    def _fill_by_run(self, recording: Recording, fitted: State) -> tuple[Array, Array]:
        """Return mean and variance (N, D) of a standardised recording by one run."""
        index = np.flatnonzero([name != recording.name for name in self.names_])
        new, others = self._sequences([recording]), self.sequences_.rows(index)
        state = refine_state(new, fitted.rows(index), others, self.hyper_, self.refine_iter)
        mean, variance = entry_moments(state)
        return correct_means(mean, others.join(new)), variance[-1, : len(recording.times)]
