"""Expectations under Q that both the updates and the bound need.

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

import numpy as np

from mocapbench.baselines.alignment.model import State
from mocapbench.baselines.alignment.ring import Ring
from mocapbench.baselines.alignment.sequences import Sequences
from mocapbench.basics.arrays import Array

__all__ = ["distance", "emission", "log_likelihood", "moments", "residuals", "roughness"]

_LOG_2PI = np.log(2.0 * np.pi)


def emission(sequences: Sequences, cycles: Ring, precisions: Array, labels: Array) -> Array:
    r"""Return the expected log-likelihood of each frame in each state: (K, N, M).

    HLM eq. (10) with its constants. The terms
    :math:`\tfrac12\log(\lambda/2\pi) - \tfrac12\lambda\langle(x - z)^2\rangle` are first averaged
    over the styles of a sequence, so that the cost for each frame does not grow with their number.
    """
    constant = labels @ (0.5 * (np.log(precisions) - _LOG_2PI))
    linear = _average_styles(labels, precisions * cycles.mean)
    quadratic = _average_styles(labels, precisions * (cycles.mean**2 + cycles.variance))
    frame = sequences.visible @ constant[:, :, None]
    frame -= 0.5 * (sequences.values**2 @ (labels @ precisions)[:, :, None])
    moments = sequences.values @ linear - 0.5 * (sequences.visible @ quadratic)
    return np.asarray((frame + moments) * sequences.frames[:, :, None])


def log_likelihood(state: State, sequences: Sequences) -> Array:
    """Return the expected log-likelihood of each sequence in each style: (K, C)."""
    precisions = state.parameters.precisions
    constant = sequences.counts @ (0.5 * (np.log(precisions) - _LOG_2PI)).T
    return np.asarray(constant - 0.5 * (residuals(state, sequences) * precisions).sum(axis=2))


def residuals(state: State, sequences: Sequences) -> Array:
    """Return the expected sum of squared residuals of the visible entries: (K, C, F)."""
    mean, variance = state.cycles.mean, state.cycles.variance
    explained = _over_states(state.evidence.counts, mean**2 + variance)
    explained -= 2.0 * _over_states(state.evidence.sums, mean)
    return np.asarray(sequences.squares[:, None] + explained)


def roughness(cycles: Ring, reference: Array) -> float:
    """Return the expected sum of squared steps of all cycles minus a reference curve (M, F)."""
    deviation = cycles.mean - reference[:, None]
    steps = np.roll(deviation, -1, axis=0) - deviation
    return float((steps**2).sum() + 2.0 * (cycles.variance - cycles.neighbour).sum())


def distance(cycles: Ring, parent: Array) -> float:
    """Return the expected sum of squared distances of all cycles from the parent (M, F)."""
    return float(((cycles.mean - parent[:, None]) ** 2 + cycles.variance).sum())


def moments(state: State) -> tuple[Array, Array]:
    """Return the mean and variance of every entry, noise included: (K, N, F) each.

    These are the moments of the mixture over states and styles. HLM eq. (18) weights styles by
    their precision instead.
    """
    cycles, noise = state.cycles, 1.0 / state.parameters.precisions
    mean = _average_paths(state, cycles.mean)
    second = _average_paths(state, cycles.mean**2 + cycles.variance + noise)
    return mean, second - mean**2


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
