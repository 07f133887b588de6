"""One latent cycle to which every recording is aligned: the continuous profile model on a ring."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.baselines.alignment.em import Run
from mocapbench.baselines.alignment.estimator import CycleAligner
from mocapbench.baselines.alignment.fitting import random_cycle
from mocapbench.baselines.alignment.model import Hyperparameters
from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.alignment.profile import fit_profile, prototype

__all__ = ["CPM"]


class CPM(CycleAligner):
    r"""A latent trace of one cycle; recordings are noisy, warped copies of it, by EM.

    The cyclic left-to-right Markov chain and the noise are those of `CyclicAlignment`; there is one
    trace, a point estimate, and one noise variance a channel. The original's factors of amplitude,
    made for abundances, are left out. The model works on channels of zero mean and unit variance.

    Parameters
    ----------
    n_states : int or None, default=None
        Number M of states; None stands for two for each frame of a cycle, whose length is estimated
        by autocorrelation. At least ``2 * max_jump + 1``.
    max_jump : int, default=3
        Most states J by which one frame can be ahead of the one before.
    n_restarts : int, default=1
        Number of runs of EM, each from a random recording; the one of highest likelihood is kept.
    max_iter : int, default=60
        Largest number of iterations of a run.
    tolerance : float, default=1e-5
        A run has converged when an iteration raises the penalised log-likelihood by less than this
        per visible entry.
    regularisation : float, default=0.1
        :math:`\eta` of the trace's roughness and of the Dirichlet prior of the jumps.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the starts.

    Attributes
    ----------
    path_ : tuple of ndarray of int, each of shape (N_k,)
        The likeliest state of each frame of each recording, jointly (Viterbi).
    cycle_length_ : int
        Number M of states.
    trace_ : ndarray of shape (M, D)
        The latent trace.
    prototypes_ : ndarray of shape (K, M, D)
        Each recording's own cycle, warped by its path and averaged over its cycles.
    log_likelihood_ : ndarray of shape (n_iterations_ + 1,)
        The penalised log-likelihood at the start and after each iteration.
    n_iterations_ : int
    converged_ : bool

    References
    ----------
    Listgarten, Neal, Roweis and Emili (2005), Multiple alignment of continuous time series, NIPS
    17; made cyclic as in HLM §4, "CPM".
    """

    def __init__(
        self,
        *,
        n_states: int | None = None,
        max_jump: int = 3,
        n_restarts: int = 1,
        max_iter: int = 60,
        tolerance: float = 1e-5,
        regularisation: float = 0.1,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_states = n_states
        self.max_jump = max_jump
        self.n_restarts = n_restarts
        self.max_iter = max_iter
        self.tolerance = tolerance
        self.regularisation = regularisation
        self.random_state = random_state

    def _hyperparameters(self) -> Hyperparameters:
        return Hyperparameters(self.regularisation, PRIORS["normalised"])

    def _learn(self, rng: np.random.Generator) -> Run:
        runs = [
            fit_profile(
                random_cycle(self.sequences_, self.cycle_length_, rng),
                self.sequences_,
                self.hyper_,
                max_jump=self.max_jump,
                max_iter=self.max_iter,
                tolerance=self.tolerance,
            )
            for _ in range(self.n_restarts)
        ]
        return max(runs, key=lambda run: run.bounds[-1])

    def _describe(self, run: Run, order: Sequence[int]) -> None:
        self.log_likelihood_ = np.array(run.bounds)
        trace, arrays = run.state.cycles.mean[:, 0], self.sequences_.arrays()
        prototypes = [
            prototype(arrays[k], path, trace) for k, path in zip(order, self.path_, strict=True)
        ]
        self.trace_, self.prototypes_ = self._unscaled(trace), self._unscaled(np.stack(prototypes))
