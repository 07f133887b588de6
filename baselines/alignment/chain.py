r"""The hidden Markov chain of HLM: cyclic, left to right, with jumps of 1 to J states (eq. 1).

Each frame advances by at least one state. The forward pass works with logarithms, because with 62
channels the likelihoods of two states differ by more than the range of a double. It stores the
*shares*: the probability of each jump given the state that it leads to and the earlier frames. The
backward pass then multiplies probabilities, :math:`\gamma_{i-1}(m - j) = \sum_j
\gamma_i(m)\,s_{ij}(m)`, which cannot overflow. Padding counts as frames without evidence, which do
not affect earlier frames. All sequences are processed together; internally arrays have shape
(N, M, K), so that a jump is a slice.

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Array

__all__ = ["forward_backward", "viterbi"]


def forward_backward(
    emission: Array, jumps: Array, frames: NDArray[np.bool_]
) -> tuple[Array, Array, Array]:
    """Return the posterior of the paths; the prior of the first state is uniform.

    Parameters
    ----------
    emission : ndarray of shape (K, N, M)
        Logarithm of each frame's likelihood in each state, 0 at the padding.
    jumps : ndarray of shape (K, J)
        Probabilities of the jumps.
    frames : ndarray of bool, shape (K, N)
        False at the padding.

    Returns
    -------
    occupancy : ndarray of shape (K, N, M)
        Probability of each state at each frame; 0 at the padding.
    counts : ndarray of shape (K, J)
        Expected number of jumps of each length.
    entropy : ndarray of shape (K,)
        Entropy of the posterior over paths.
    """
    log_jumps = np.log(jumps)
    filtered, shares = _forward(np.ascontiguousarray(emission.transpose(1, 2, 0)), log_jumps.T)
    evidence = _log_sum(filtered)
    occupancy, counts = _backward(np.exp(filtered - evidence), shares, frames.T)
    # The entropy is the evidence less the expected log-probability of a path and its frames.
    expected = (occupancy * emission).sum(axis=(1, 2)) + (counts * log_jumps).sum(axis=1)
    return occupancy, counts, evidence - expected


def viterbi(
    emission: Array, jumps: Array, frames: NDArray[np.bool_]
) -> tuple[NDArray[np.intp], ...]:
    """Return the most likely path (N_k,) of each sequence; arguments as in `forward_backward`."""
    log_jumps = np.log(jumps).T[:, None]
    scores = np.ascontiguousarray(emission.transpose(1, 2, 0))
    choices = np.zeros(scores.shape, dtype=np.intp)
    for i in range(1, len(scores)):
        candidates = np.stack(_gather_origins(scores[i - 1], len(log_jumps))) + log_jumps
        choices[i] = candidates.argmax(axis=0)
        scores[i] += candidates.max(axis=0)
    return tuple(
        _trace_path(scores[length - 1, :, k], choices[:length, :, k])
        for k, length in enumerate(frames.sum(axis=1))
    )


def _forward(emission: Array, log_jumps: Array) -> tuple[Array, Array]:
    """Return the joint log-density (M, K) of last state and frames, and the shares.

    Step i adds the log-probabilities of all jumps into a state (log-sum-exp) and the evidence of
    frame i.
    """
    n_frames, n_states, n_sequences = emission.shape
    max_jump = len(log_jumps)
    shares = np.empty((n_frames - 1, max_jump, n_states, n_sequences))
    filtered = emission[0]
    for i, evidence in enumerate(emission[1:]):
        terms = shares[i]
        for term, origins, log_jump in zip(
            terms, _gather_origins(filtered, max_jump), log_jumps, strict=True
        ):
            np.add(origins, log_jump, out=term)
        # log Σ exp of the terms, less their maximum, and each term's share of the sum.
        top = terms.max(axis=0)
        terms -= top
        np.exp(terms, out=terms)
        total = terms.sum(axis=0)
        terms /= total
        filtered = np.log(total) + top + evidence
    return filtered, shares


def _backward(last: Array, shares: Array, frames: NDArray[np.bool_]) -> tuple[Array, Array]:
    """Return the occupancy (K, N, M) and the expected jumps (K, J)."""
    occupancy = np.empty((len(frames), *last.shape))
    occupancy[-1] = last
    counts = np.zeros((shares.shape[1], last.shape[1]))
    for i in reversed(range(len(shares))):
        # γ_{i+1}(m) s_ij(m), the probability of each jump into each state.
        flow = occupancy[i + 1] * shares[i]
        counts += flow.sum(axis=1) * frames[i + 1]
        occupancy[i] = _sum_over_jumps(flow)
    occupancy *= frames[:, None]
    return np.ascontiguousarray(occupancy.transpose(2, 0, 1)), counts.T


def _gather_origins(states: Array, max_jump: int) -> list[Array]:
    """Return the values (M, K) at the origin of each jump into each state: J of them."""
    n_states = len(states)
    ring = np.concatenate([states[-max_jump:], states])
    return [ring[max_jump - j : max_jump - j + n_states] for j in range(1, max_jump + 1)]


def _sum_over_jumps(flow: Array) -> Array:
    """Sum the probabilities (J, M, K) of jumps into states at the jumps' origins: (M, K)."""
    ring = np.concatenate([flow, flow[:, : len(flow)]], axis=1)
    n_states, total = flow.shape[1], np.zeros(flow.shape[1:])
    for j, into in enumerate(ring, 1):
        total += into[j : j + n_states]
    return total


def _trace_path(final: Array, choices: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return the path (N,) by the best jumps (N, M), minus one, back from the best final state."""
    n_frames, n_states = choices.shape
    path = np.empty(n_frames, dtype=np.intp)
    path[-1] = final.argmax()
    for i in range(n_frames - 1, 0, -1):
        path[i - 1] = (path[i] - 1 - choices[i, path[i]]) % n_states
    return path


def _log_sum(terms: Array) -> Array:
    """Return the logarithm of the sum of exponentials over the first axis."""
    top = terms.max(axis=0)
    return np.asarray(np.log(np.exp(terms - top).sum(axis=0)) + top)
