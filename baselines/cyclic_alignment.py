"""Styles of cyclic motion, found and aligned without labels: the hierarchical model of HLM."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.alignment.em import Run
from mocapbench.baselines.alignment.estimator import CycleAligner
from mocapbench.baselines.alignment.fitting import Settings, best_fit
from mocapbench.baselines.alignment.inference import moments, refine
from mocapbench.baselines.alignment.model import Hyperparameters
from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.alignment.synthesis import blended, draw_cycles, draw_sequences
from mocapbench.baselines.protocols import (
    Blender,
    Imputer,
    Inductive,
    Prediction,
    SampleByFrameByChannel,
    Synthesiser,
)
from mocapbench.datasets import FrameByChannel, Frames, Recording

__all__ = ["CyclicAlignment"]


class CyclicAlignment(CycleAligner, Imputer, Inductive, Blender, Synthesiser):
    r"""Cycles of C latent styles with a common parent, warped in time, by variational EM.

    A recording is of one style; its frames follow that style's cycle of M states through a cyclic
    left-to-right Markov chain, each frame 1 to J states on, and add noise of the style's own
    variance per channel. The styles' cycles are smooth Gaussian deviations from their parent.
    Hidden entries are integrated out. The model works on channels of zero mean and unit variance.

    Parameters
    ----------
    n_styles : int, default=20
        Number C of styles; EM leaves empty the ones for which it has no use.
    n_states : int or None, default=None
        Number M of states of a cycle; None stands for two for each frame of a cycle, whose length
        is estimated by autocorrelation. At least ``2 * max_jump + 1``.
    max_jump : int, default=3
        Most states J by which one frame can be ahead of the one before.
    n_restarts : int, default=3
        Number of runs of EM from random starts; the one with the highest bound is kept.
    max_iter : int, default=40
        Largest number of iterations of a run.
    tolerance : float, default=1e-5
        A run has converged when an iteration raises the bound by less than this per visible entry.
    n_inner : int, default=3
        Sweeps of the E-step in an iteration.
    regularisation : float, default=0.1
        :math:`\eta` of the parent's roughness and of the Dirichlet priors of styles and jumps.
    closeness : float, default=0.01
        Precision :math:`\lambda_{\bar z}` of a cycle about its parent, where it starts.
    learn_closeness : bool, default=False
        Whether :math:`\lambda_{\bar z}` is learnt; the paper keeps it fixed.
    smoothness : float, default=0.1
        Precision :math:`\lambda_s` of a cycle's steps, where it starts; it is learnt.
    prior : {"normalised", "centred", "paper"}, default="normalised"
        The prior of a cycle: HLM's, normalised; one about the parent, from which a cycle deviates
        smoothly; or HLM's as the paper has it, which is not a density.
    refine_iter : int, default=10
        Iterations of EM, from where `fit` ended, that `impute` gives to a recording together with
        the fitted ones.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the starts.

    Attributes
    ----------
    labels_ : ndarray of int, shape (K,)
        The likeliest style of each recording.
    path_ : tuple of ndarray of int, each of shape (N_k,)
        The likeliest state of each frame of each recording, jointly (Viterbi).
    cycle_length_ : int
        Number M of states.
    cycles_ : ndarray of shape (C, M, D)
        Mean cycle of each style, in the channels' units.
    probabilities_ : ndarray of shape (K, C)
        Probability of each style for each recording.
    bound_ : ndarray of shape (n_iterations_ + 1,)
        The variational bound at the start and after each iteration, for standardised channels.
    restart_bounds_ : ndarray of shape (n_restarts,)
        The bound at which each run ended.
    n_iterations_ : int
        Iterations of the run that is kept.
    converged_ : bool
        Whether it converged.

    References
    ----------
    Pan and Torresani (2009), Unsupervised hierarchical modeling of locomotion styles, ICML.
    """

    def __init__(
        self,
        *,
        n_styles: int = 20,
        n_states: int | None = None,
        max_jump: int = 3,
        n_restarts: int = 3,
        max_iter: int = 40,
        tolerance: float = 1e-5,
        n_inner: int = 3,
        regularisation: float = 0.1,
        closeness: float = 0.01,
        learn_closeness: bool = False,
        smoothness: float = 0.1,
        prior: str = "normalised",
        refine_iter: int = 10,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_styles = n_styles
        self.n_states = n_states
        self.max_jump = max_jump
        self.n_restarts = n_restarts
        self.max_iter = max_iter
        self.tolerance = tolerance
        self.n_inner = n_inner
        self.regularisation = regularisation
        self.closeness = closeness
        self.learn_closeness = learn_closeness
        self.smoothness = smoothness
        self.prior = prior
        self.refine_iter = refine_iter
        self.random_state = random_state

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the mixture over styles and states at the hidden entries of each recording.

        A recording joins the fitted ones, in place of one that has its name, for some iterations of
        EM: from the style that suits it best and, if one is empty, from a style of its own. The
        higher bound decides.

        Raises
        ------
        ValueError
            If channels differ.
        """
        self._check_fitted(recordings)
        return [self._imputed(recording) for recording in recordings]

    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Draw recordings of any length at the frame rate of the fitted ones, noise included.

        Each in the style and at the pace of a fitted recording, with a new cycle of that style.
        """
        check_is_fitted(self)
        rng = np.random.default_rng(random_state)
        return self._unscaled(draw_sequences(self.state_, n_samples, len(times), rng))

    def sample_cycles(
        self, style: int, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Draw cycles (n, M, D) of a style, without noise."""
        check_is_fitted(self)
        rng = np.random.default_rng(random_state)
        return self._unscaled(draw_cycles(self.state_, style, n_samples, rng))

    def blend(self, weights: ArrayLike) -> FrameByChannel:
        """Return the styles' mean cycles mixed by weights (N, C) that vary from frame to frame.

        HLM §4.2. The frames start at state 0 and go on at the mean pace of the fitted recordings.

        Raises
        ------
        ValueError
            If the weights are not (N, n_styles), are negative, or a row's sum is not 1.
        """
        check_is_fitted(self)
        return self._unscaled(blended(self.state_, np.asarray(weights, dtype=np.float64)))

    def _hyperparameters(self) -> Hyperparameters:
        return Hyperparameters(self.regularisation, PRIORS[self.prior])

    def _learn(self, rng: np.random.Generator) -> Run:
        self.settings_ = Settings(
            n_styles=self.n_styles,
            n_states=self.cycle_length_,
            max_jump=self.max_jump,
            closeness=self.closeness,
            learn_closeness=self.learn_closeness,
            smoothness=self.smoothness,
            hyper=self.hyper_,
            n_inner=self.n_inner,
            tolerance=self.tolerance,
        )
        best, ends = best_fit(
            self.sequences_,
            self.settings_,
            n_restarts=self.n_restarts,
            max_iter=self.max_iter,
            rng=rng,
        )
        self.restart_bounds_ = np.array(ends)
        return best

    def _describe(self, run: Run, order: Sequence[int]) -> None:
        self.bound_ = np.array(run.bounds)
        self.cycles_ = self._unscaled(run.state.cycles.mean.swapaxes(0, 1))
        self.probabilities_ = run.state.labels[list(order)]
        self.labels_: NDArray[np.intp] = self.probabilities_.argmax(axis=1)

    def _imputed(self, recording: Recording) -> Prediction:
        others = np.flatnonzero([name != recording.name for name in self.names_])
        state = refine(
            self._sequences([recording]),
            self.state_.rows(others),
            self.sequences_.rows(others),
            self.settings_,
            self.refine_iter,
        )
        mean, variance = (moment[-1, : len(recording.times)] for moment in moments(state))
        return Prediction.around(recording, self._unscaled(mean), variance * self.scaling_.scale**2)
