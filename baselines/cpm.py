"""The continuous profile model on a ring: one latent cycle to which every recording is aligned."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.alignment.aligner import CycleAligner
from mocapbench.baselines.alignment.cycle_model import Hyperparameters, State
from mocapbench.baselines.alignment.cycle_start import prototypes
from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.alignment.profile import fit_profile
from mocapbench.baselines.alignment.restarts import random_cycle
from mocapbench.baselines.common.ascent import Ascent
from mocapbench.basics.arrays import Array

__all__ = ["CPM"]


class CPM(CycleAligner):
    r"""One cycle, learnt from all recordings, of which each is a noisy, time-warped copy.

    The cyclic left-to-right Markov chain and the noise are those of `CyclicAlignment`. There is one
    trace, a point estimate, and one noise variance for each channel. The amplitude factors of the
    original model, meant for abundances, are left out. The model works on channels of zero mean and
    unit variance.

    Parameters
    ----------
    n_states : int or None, default=None
        Number M of states, at least ``2 * max_jump + 1``. None means two for each frame of a
        cycle, whose length is estimated by autocorrelation.
    max_jump : int, default=3
        Largest number J of states between consecutive frames.
    n_restarts : int, default=1
        Number of runs of EM, each from a random recording; the one with the highest likelihood is
        kept.
    max_iter : int, default=60
        Largest number of iterations of a run.
    tol : float, default=1e-5
        A run has converged when an iteration raises the penalised log-likelihood by less than
        ``tol`` per visible entry.
    regularisation : float, default=0.1
        Weight :math:`\eta` of the penalty on the trace's squared steps and of the Dirichlet prior
        of the jumps.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the starts.

    Attributes
    ----------
    path_ : tuple of ndarray of int, each of shape (N_k,)
        The most likely state sequence of each recording (Viterbi).
    cycle_length_ : int
        Number M of states.
    trace_ : ndarray of shape (M, D)
        The latent trace.
    prototypes_ : ndarray of shape (K, M, D)
        Each recording warped onto the cycle by its path, and averaged over its cycles.
    log_likelihood_ : ndarray of shape (n_iterations + 1,)
        The penalised log-likelihood at the start and after each iteration.
    n_iterations_ : int
        Iterations of the run that was kept.
    converged_ : bool
        Whether that run converged.

    Notes
    -----
    With the trace :math:`z_m` of M states, counted modulo M, and the state :math:`\pi_i` of frame
    i:

    .. math::

        p(\pi_i = m \mid \pi_{i-1} = m - j) = d_j, \quad j = 1 \ldots J, \qquad
        x_{if} \sim N(z_{\pi_i f}, \sigma_f^2)

    ``docs/mathematics/alignment.md`` has the algorithm.

    References
    ----------
    J. Listgarten, R. M. Neal, S. T. Roweis and A. Emili (2005), Multiple Alignment of Continuous
    Time Series, NIPS 17.

    W. Pan and L. Torresani (2009), Unsupervised Hierarchical Modeling of Locomotion Styles, ICML,
    §4, "CPM": the cyclic version.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import CPM
    >>> from mocapbench.datasets import Recording
    >>> def walk(name, n_frames, period):
    ...     angle = 2 * np.pi * np.arange(n_frames) / period
    ...     values = np.column_stack([np.sin(angle), np.cos(angle)])
    ...     return Recording(name, np.arange(n_frames) / 30, values, ("hip", "knee"), ("deg",) * 2)
    >>> model = CPM(n_states=16, random_state=0).fit([walk("slow", 40, 10), walk("fast", 30, 8)])
    >>> model.trace_.shape, [len(path) for path in model.path_]
    ((16, 2), [40, 30])
    """

    def __init__(
        self,
        *,
        n_states: int | None = None,
        max_jump: int = 3,
        n_restarts: int = 1,
        max_iter: int = 60,
        tol: float = 1e-5,
        regularisation: float = 0.1,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_states = n_states
        self.max_jump = max_jump
        self.n_restarts = n_restarts
        self.max_iter = max_iter
        self.tol = tol
        self.regularisation = regularisation
        self.random_state = random_state

    def _hyperparameters(self) -> Hyperparameters:
        return Hyperparameters(
            self.regularisation, PRIORS["normalised"], max_jump=self.max_jump, tol=self.tol
        )

    def _learn(self, rng: np.random.Generator) -> Ascent[State]:
        runs = [
            fit_profile(
                random_cycle(self.sequences_, self.cycle_length_, rng),
                self.sequences_,
                self.hyper_,
                self.max_iter,
            )
            for _ in range(self.n_restarts)
        ]
        return max(runs, key=lambda run: run.objectives[-1])

    def _describe(self, run: Ascent[State], places: NDArray[np.intp]) -> None:
        self.log_likelihood_: Array = np.array(run.objectives)
        trace = run.state.cycles.mean[:, 0]
        given = self.sequences_.rows(places)
        self.trace_: Array = self._restore_units(trace)
        self.prototypes_: Array = self._restore_units(prototypes(self.path_, given, trace))
