r"""The variables of HLM: parameters θ, hyperparameters η, and the factors of the posterior Q.

Names follow HLM §2: sequence k of K, frame i of N, state m of M, style c of C, channel f of F,
jump j of J.

Pan and Torresani (2009), *Unsupervised Hierarchical Modeling of Locomotion Styles*, ICML, is cited
as HLM.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.alignment.chain import Paths
from mocapbench.baselines.alignment.priors import CyclePrior
from mocapbench.baselines.alignment.ring import Ring
from mocapbench.baselines.alignment.sequences import Sequences
from mocapbench.basics.arrays import Array

__all__ = ["CycleParameters", "Evidence", "Hyperparameters", "State"]


@dataclass(frozen=True)
class Hyperparameters:
    r"""Quantities that are chosen rather than learnt.

    Parameters
    ----------
    regularisation : float
        The weight :math:`\eta > 0` of the penalties on the parent cycle, the styles' weights and
        the jumps.
    prior : CyclePrior
        The prior of a cycle.
    max_precision : float, default=1e6
        Upper limit of :math:`\lambda_f^c`, which is unbounded for a channel that does not vary.
    """

    regularisation: float
    prior: CyclePrior
    max_precision: float = 1e6


@dataclass(frozen=True)
class CycleParameters:
    r"""Point estimates θ.

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
    """

    parent: Array
    smoothness: float
    closeness: float
    precisions: Array
    weights: Array
    jumps: Array


@dataclass(frozen=True)
class Evidence:
    """Sufficient statistics of the frames for each state, given the paths.

    Parameters
    ----------
    counts : ndarray of shape (K, M, F)
        Expected number of visible entries.
    sums : ndarray of shape (K, M, F)
        Expected sum of them.
    """

    counts: Array
    sums: Array

    @classmethod
    def of(cls, sequences: Sequences, paths: Paths) -> Evidence:
        """Return the sums over frames, weighted by the occupancies."""
        occupancy = paths.occupancy.swapaxes(1, 2)
        return cls(occupancy @ sequences.visible, occupancy @ sequences.values)

    def join(self, other: Evidence) -> Evidence:
        """Return the statistics of these sequences followed by the others."""
        return Evidence(
            np.concatenate([self.counts, other.counts]), np.concatenate([self.sums, other.sums])
        )

    def by_style(self, labels: Array) -> tuple[Array, Array]:
        """Return the counts and sums of each style: (M, C, F) both."""
        return _by_style(labels, self.counts), _by_style(labels, self.sums)


@dataclass(frozen=True)
class State:
    """The parameters θ and the factors of the posterior Q.

    Parameters
    ----------
    parameters : CycleParameters
    cycles : Ring
        Q(Z): arrays of shape (M, C, F).
    labels : ndarray of shape (K, C)
        Q(l), the paper's ψ.
    paths : Paths
        Q(π), the paper's γ and ξ.
    evidence : Evidence
        Statistics that are computed from ``paths``.
    """

    parameters: CycleParameters
    cycles: Ring
    labels: Array
    paths: Paths
    evidence: Evidence

    def rows(self, index: NDArray[np.intp]) -> State:
        """Return the state of the sequences at ``index``."""
        paths, evidence = self.paths, self.evidence
        return replace(
            self,
            parameters=replace(self.parameters, jumps=self.parameters.jumps[index]),
            labels=self.labels[index],
            paths=Paths(paths.occupancy[index], paths.jumps[index], paths.entropy[index]),
            evidence=Evidence(evidence.counts[index], evidence.sums[index]),
        )


def _by_style(labels: Array, statistic: Array) -> Array:
    """Sum (K, M, F) over sequences, weighted by the labels (K, C): (M, C, F)."""
    n_sequences, n_states, n_channels = statistic.shape
    flat = labels.T @ statistic.reshape(n_sequences, -1)
    return np.ascontiguousarray(flat.reshape(-1, n_states, n_channels).swapaxes(0, 1))
