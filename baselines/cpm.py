"""One latent cycle to which every recording is aligned: the continuous profile model on a ring."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import numpy as np
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.alignment.em import Run
from mocapbench.baselines.alignment.fitting import random_cycle
from mocapbench.baselines.alignment.inference import best_paths, infer
from mocapbench.baselines.alignment.model import Hyperparameters
from mocapbench.baselines.alignment.period import default_states
from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.alignment.profile import fit_profile, prototype
from mocapbench.baselines.alignment.sequences import Sequences
from mocapbench.baselines.alignment.validation import check_settings
from mocapbench.baselines.gp.scaling import Standardisation
from mocapbench.baselines.pooling import check_channels, check_recordings
from mocapbench.baselines.protocols import Aligner, StatePath
from mocapbench.datasets import Recording

__all__ = ["CPM"]


class CPM(Aligner):
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

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Find the trace and the alignment of the recordings to it.

        Raises
        ------
        ValueError
            If a parameter is out of range, there is no recording, channels differ, a name repeats,
            or a channel is nowhere visible.
        """
        check_settings(**vars(self))
        checked = check_recordings(recordings)
        self.channels_ = checked[0].channels
        # In order of name, so that the order in which recordings come means nothing.
        ordered = sorted(checked, key=lambda recording: recording.name)
        self.scaling_ = Standardisation.of(ordered)
        names = [recording.name for recording in ordered]
        sequences = self._sequences(ordered)
        run = self._best_run(sequences)
        self.state_, self.converged_ = run.state, run.converged
        self.log_likelihood_ = np.array(run.bounds)
        self.n_iterations_ = len(run.bounds) - 1
        self._describe(sequences, [names.index(recording.name) for recording in checked])
        self.fitted_ = {r.name: (r, path) for r, path in zip(checked, self.path_, strict=True)}
        return self

    def align(self, recordings: Sequence[Recording]) -> list[StatePath]:
        """Return the likeliest path of each recording along the trace, as in `fit` if it was there.

        Raises
        ------
        ValueError
            If channels differ.
        """
        check_is_fitted(self)
        check_channels(recordings, self.channels_)
        return [self._aligned(recording) for recording in recordings]

    def _best_run(self, sequences: Sequences) -> Run:
        rng = np.random.default_rng(self.random_state)
        self.cycle_length_ = self.n_states or default_states(sequences, self.max_jump)
        runs = [
            fit_profile(
                random_cycle(sequences, self.cycle_length_, rng),
                sequences,
                self._hyper,
                max_jump=self.max_jump,
                max_iter=self.max_iter,
                tolerance=self.tolerance,
            )
            for _ in range(self.n_restarts)
        ]
        return max(runs, key=lambda run: run.bounds[-1])

    def _describe(self, sequences: Sequences, order: list[int]) -> None:
        """State paths and prototypes in the order in which recordings were given."""
        trace = self.state_.cycles.mean[:, 0]
        paths, arrays = best_paths(self.state_, sequences), sequences.arrays()
        self.path_ = tuple(paths[k] for k in order)
        prototypes = np.stack([prototype(arrays[k], paths[k], trace) for k in order])
        scale, mean = self.scaling_.scale, self.scaling_.mean
        self.trace_, self.prototypes_ = trace * scale + mean, prototypes * scale + mean

    def _aligned(self, recording: Recording) -> StatePath:
        if recording.name in self.fitted_:
            fitted, path = self.fitted_[recording.name]
            if np.array_equal(fitted.values, recording.values, equal_nan=True):
                return path
        sequence = self._sequences([recording])
        return best_paths(infer(sequence, self.state_, self._hyper), sequence)[0]

    @property
    def _hyper(self) -> Hyperparameters:
        return Hyperparameters(self.regularisation, PRIORS["normalised"])

    def _sequences(self, recordings: Sequence[Recording]) -> Sequences:
        return Sequences.of([self.scaling_.apply(recording).values for recording in recordings])
