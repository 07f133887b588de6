r"""The model of HLM: its variables, expectations under the posterior Q, and the variational bound.

Names follow HLM §2: sequence k of K, frame i of N, state m of M, style c of C, channel f of F,
jump j of J. The bound has all terms of eq. (3), with the penalties of eq. (6).

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
from scipy.special import entr

from mocapbench.baselines.alignment.priors import CyclePrior
from mocapbench.baselines.alignment.ring import Ring
from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.basics.arrays import Array, Index

__all__ = [
    "Hyperparameters",
    "Paths",
    "State",
    "distance",
    "emission",
    "entry_moments",
    "log_likelihood",
    "lower_bound",
    "residuals",
    "roughness",
    "sequence_bounds",
]

_LOG_2PI = np.log(2.0 * np.pi)


@dataclass(frozen=True)
class Hyperparameters:
    r"""Quantities that are chosen rather than learnt; names as in `CyclicAlignment`.

    Parameters
    ----------
    regularisation : float
        The weight :math:`\eta > 0` of the penalties on the parent cycle, the styles' weights and
        the jumps.
    prior : CyclePrior
        The prior of a cycle.
    max_precision : float, default=1e6
        Upper limit of :math:`\lambda_f^c`, which is unbounded for a channel that does not vary.
    closeness, smoothness : float, default=1.0
        Where EM starts; ``smoothness`` is learnt.
    learn_closeness : bool, default=False
        Whether ``closeness`` is learnt, too.
    max_jump : int, default=3
        J.
    n_styles : int, default=1
        C.
    grouping : str, default="random"
        How the first styles are made.
    n_inner : int, default=1
        Sweeps of the E-step in an iteration of EM.
    tol : float, default=1e-5
        EM has converged when an iteration raises the objective by less per visible entry.
    """

    regularisation: float
    prior: CyclePrior
    max_precision: float = 1e6
    closeness: float = 1.0
    smoothness: float = 1.0
    learn_closeness: bool = False
    max_jump: int = 3
    n_styles: int = 1
    grouping: str = "random"
    n_inner: int = 1
    tol: float = 1e-5


@dataclass(frozen=True)
class Paths:
    """The posterior Q(π) of the state sequences, the paper's γ and ξ, and what follows from it.

    Parameters
    ----------
    occupancy : ndarray of shape (K, N, M)
        Probability of each state at each frame; 0 at the padding.
    n_jumps : ndarray of shape (K, J)
        Expected number of jumps of each length.
    entropy : ndarray of shape (K,)
        Entropy of the posterior over paths.
    counts, sums : ndarray of shape (K, M, F)
        Expected number and sum of the visible entries in each state.
    """

    occupancy: Array
    n_jumps: Array
    entropy: Array
    counts: Array
    sums: Array

    @classmethod
    def of(cls, sequences: Sequences, posterior: tuple[Array, Array, Array]) -> Paths:
        """Sum the entries of sequences over frames, given the result of `forward_backward`."""
        by_state = posterior[0].swapaxes(1, 2)
        return cls(*posterior, by_state @ sequences.visible, by_state @ sequences.values)

    def rows(self, index: Index) -> Paths:
        """Return the paths of the sequences at ``index``."""
        return Paths(*(getattr(self, each.name)[index] for each in fields(self)))

    def by_style(self, labels: Array) -> tuple[Array, Array]:
        """Return the counts and sums of each style: (M, C, F) both."""
        return _by_style(labels, self.counts), _by_style(labels, self.sums)


@dataclass(frozen=True)
class State:
    r"""The parameters θ, which are point estimates, and the factors of the posterior Q.

    Parameters
    ----------
    parent : ndarray of shape (M, F)
        Parent cycle :math:`\bar z`.
    smoothness, closeness : float
        Precisions :math:`\lambda_s` of the steps of a cycle and :math:`\lambda_{\bar z}` of its
        distance from the parent.
    precisions : ndarray of shape (C, F)
        Noise precisions :math:`\lambda_f^c`.
    weights : ndarray of shape (C,)
        Probabilities τ of the styles.
    jumps : ndarray of shape (K, J)
        Probabilities :math:`d_j^k` of the jumps.
    cycles : Ring
        Q(Z): arrays of shape (M, C, F).
    labels : ndarray of shape (K, C)
        Q(l), the paper's ψ.
    paths : Paths
        Q(π).
    """

    parent: Array
    smoothness: float
    closeness: float
    precisions: Array
    weights: Array
    jumps: Array
    cycles: Ring
    labels: Array
    paths: Paths

    def rows(self, index: Index) -> State:
        """Return the state of the sequences at ``index``."""
        return replace(
            self,
            jumps=self.jumps[index],
            labels=self.labels[index],
            paths=self.paths.rows(index),
        )


def emission(sequences: Sequences, cycles: Ring, precisions: Array, labels: Array) -> Array:
    r"""Return the expected log-likelihood of each frame in each state: (K, N, M).

    HLM eq. (10) with its constants. The terms
    :math:`\tfrac12\log(\lambda/2\pi) - \tfrac12\lambda\langle(x - z)^2\rangle` are first averaged
    over the styles of a sequence, so that the cost for each frame does not grow with their number.
    """
    # −½ λ ⟨(x − z)²⟩ = −½ λ x² + x λ⟨z⟩ − ½ λ⟨z²⟩, whose factors of x are averaged over styles.
    constant = labels @ (0.5 * (np.log(precisions) - _LOG_2PI))
    linear = _average_styles(labels, precisions * cycles.mean)
    quadratic = _average_styles(labels, precisions * (cycles.mean**2 + cycles.variance))
    frame = sequences.visible @ constant[:, :, None]
    frame -= 0.5 * (sequences.values**2 @ (labels @ precisions)[:, :, None])
    moments = sequences.values @ linear - 0.5 * (sequences.visible @ quadratic)
    return np.asarray((frame + moments) * sequences.frames[:, :, None])


def log_likelihood(state: State, sequences: Sequences) -> Array:
    """Return the expected log-likelihood of each sequence in each style: (K, C)."""
    precisions = state.precisions
    constant = sequences.counts @ (0.5 * (np.log(precisions) - _LOG_2PI)).T
    return np.asarray(constant - 0.5 * (residuals(state, sequences) * precisions).sum(axis=2))


def residuals(state: State, sequences: Sequences) -> Array:
    """Return the expected sum of squared residuals of the visible entries: (K, C, F)."""
    # Σ v x² − 2 Σ γ v x ⟨z⟩ + Σ γ v ⟨z²⟩
    mean, variance = state.cycles.mean, state.cycles.variance
    explained = _over_states(state.paths.counts, mean**2 + variance)
    explained -= 2.0 * _over_states(state.paths.sums, mean)
    return np.asarray(sequences.squares[:, None] + explained)


def roughness(cycles: Ring, reference: Array) -> float:
    """Return the expected sum of squared steps of all cycles minus a reference curve (M, F)."""
    deviation = cycles.mean - reference[:, None]
    # ⟨(z_{m+1} − z_m)²⟩ has the two variances less twice the covariance.
    steps = np.roll(deviation, -1, axis=0) - deviation
    return float((steps**2).sum() + 2.0 * (cycles.variance - cycles.neighbour).sum())


def distance(cycles: Ring, parent: Array) -> float:
    """Return the expected sum of squared distances of all cycles from the parent (M, F)."""
    return float(((cycles.mean - parent[:, None]) ** 2 + cycles.variance).sum())


def entry_moments(state: State) -> tuple[Array, Array]:
    """Return the mean and variance of every entry, noise included: (K, N, F) each.

    These are the moments of the mixture over states and styles. HLM eq. (18) weights styles by
    their precision instead.
    """
    # ⟨x⟩ and ⟨x²⟩ over states and styles; the variance is their difference.
    cycles, noise = state.cycles, 1.0 / state.precisions
    mean = _average_paths(state, cycles.mean)
    second = _average_paths(state, cycles.mean**2 + cycles.variance + noise)
    return mean, second - mean**2


def lower_bound(state: State, sequences: Sequences, hyper: Hyperparameters) -> float:
    """Return the lower bound on log p(X, θ); valid for any state, not only after an update."""
    shared = _cycle_terms(state, hyper) + hyper.regularisation * _log_prior(state)
    return float(sequence_bounds(state, sequences, hyper).sum() + shared)


def sequence_bounds(state: State, sequences: Sequences, hyper: Hyperparameters) -> Array:
    """Return the terms of each sequence, with its label, path and jumps: (K,)."""
    labels, paths = state.labels, state.paths
    label = (labels * np.log(state.weights) + entr(labels)).sum(axis=1)
    data = (labels * log_likelihood(state, sequences)).sum(axis=1)
    log_jumps = np.log(state.jumps)
    jumps = ((paths.n_jumps + hyper.regularisation) * log_jumps).sum(axis=1)
    return np.asarray(label + data + jumps + paths.entropy - np.log(len(state.parent)))


def _over_states(evidence: Array, statistic: Array) -> Array:
    """Sum (K, M, F) times (M, C, F) over the states, one matrix product a channel: (K, C, F)."""
    left = np.ascontiguousarray(evidence.transpose(2, 0, 1))
    right = np.ascontiguousarray(statistic.transpose(2, 0, 1))
    return (left @ right).transpose(1, 2, 0)


def _average_styles(labels: Array, statistic: Array) -> Array:
    """Average (M, C, F) over the styles of each sequence: (K, F, M)."""
    n_states, n_styles, n_channels = statistic.shape
    flat = labels @ statistic.transpose(1, 2, 0).reshape(n_styles, -1)
    return np.asarray(flat.reshape(-1, n_channels, n_states))


def _average_paths(state: State, statistic: Array) -> Array:
    """Average (M, C, F) over the styles and states of each frame: (K, N, F)."""
    return np.asarray(state.paths.occupancy @ np.einsum("kc,mcf->kmf", state.labels, statistic))


def _by_style(labels: Array, statistic: Array) -> Array:
    """Sum (K, M, F) over sequences, weighted by the labels (K, C): (M, C, F)."""
    n_sequences, n_states, n_channels = statistic.shape
    flat = labels.T @ statistic.reshape(n_sequences, -1)
    return np.ascontiguousarray(flat.reshape(-1, n_states, n_channels).swapaxes(0, 1))


def _cycle_terms(state: State, hyper: Hyperparameters) -> float:
    """Return the terms of the cycles: expected log-prior plus entropy of Q(Z)."""
    cycles = state.cycles
    n_states, n_styles, n_channels = cycles.mean.shape
    normaliser = hyper.prior.log_normaliser(state.smoothness, state.closeness, n_states)
    # ⟨log p(Z)⟩ has expected squares; the entropy of Gaussians has the determinant of S.
    energy = state.smoothness * roughness(cycles, hyper.prior.reference(state.parent))
    energy += state.closeness * distance(cycles, state.parent)
    log_determinants = cycles.log_determinant.sum()
    n_cycles = n_styles * n_channels
    entropy = 0.5 * (n_cycles * n_states * (1.0 + np.log(2.0 * np.pi)) - log_determinants)
    return float(n_cycles * normaliser - 0.5 * energy + entropy)


def _log_prior(state: State) -> float:
    """Return the log-prior of parent and style weights, divided by η, without constants."""
    steps = np.roll(state.parent, -1, axis=0) - state.parent
    return float(np.log(state.weights).sum() - (steps**2).sum())
