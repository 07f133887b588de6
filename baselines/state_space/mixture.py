"""A mixture of linear Gaussian state-space models, by classification EM.

Each sequence belongs to the component that explains it best. An iteration improves each component
by one step of EM on its members, and then assigns all sequences anew. Neither lowers the objective:
the log-density of all sequences and of their components, plus the log-prior, in which every
component has one sequence more than it has members.

G. Celeux and G. Govaert (1992), *A Classification EM Algorithm for Clustering and Two Stochastic
Versions*, Computational Statistics and Data Analysis 14(3).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.ascent import Ascent, ascend
from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.baselines.state_space.expectation_maximisation import (
    maximise_parameters,
    start_parameters,
)
from mocapbench.baselines.state_space.kalman import filter_states, smooth_states
from mocapbench.baselines.state_space.linear_gaussian import Priors, StateSpaceParameters
from mocapbench.basics.arrays import Array

__all__ = ["Mixture", "classification_em", "seed_mixture"]

Labels = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Mixture:
    """C components, and the one that each of K sequences belongs to.

    Parameters
    ----------
    components : tuple of StateSpaceParameters
        The parameters of each component.
    weights : ndarray of shape (C,)
        The probability of each component.
    labels : ndarray of int, shape (K,)
        The component of each sequence.
    objective : float
        The log-density and the log-prior.
    """

    components: tuple[StateSpaceParameters, ...]
    weights: Array
    labels: Labels
    objective: float

    @classmethod
    def assign_sequences(
        cls,
        components: Sequence[StateSpaceParameters],
        weights: Array,
        data: Sequences,
        priors: Priors,
    ) -> Mixture:
        """Return the mixture with every sequence in the component that explains it best."""
        # log p(y_k | component) + log weight; filter_states returns the first of these last.
        evidence = [filter_states(parameters, data)[-1] for parameters in components]
        joint = np.column_stack(evidence) + np.log(weights)
        prior = sum(parameters.log_prior(priors) for parameters in components)
        value = joint.max(axis=1).sum() + np.log(weights).sum() + prior
        return cls(tuple(components), weights, joint.argmax(axis=1), float(value))

    def improve(self, data: Sequences, priors: Priors) -> Mixture:
        """Return the mixture after a step of EM in each component and a new assignment."""
        sizes = np.bincount(self.labels, minlength=len(self.weights))
        components = list(self.components)
        for c in np.flatnonzero(sizes):
            members = data.rows(np.flatnonzero(self.labels == c))
            components[c] = maximise_parameters(
                smooth_states(components[c], members), members, priors
            )
        return self.assign_sequences(components, (sizes + 1.0) / (sizes + 1.0).sum(), data, priors)


def seed_mixture(states: Array, data: Sequences, seeds: Labels, priors: Priors) -> Mixture:
    """Return a mixture whose components each fit one sequence, of those at ``seeds`` (C,).

    Parameters
    ----------
    states : ndarray of shape (K, N, q)
        Initial states of all sequences.
    """
    alone = [data.rows(np.array([seed])) for seed in seeds]
    components = [
        start_parameters(states[[seed], : one.lengths[0]], one, priors)
        for seed, one in zip(seeds, alone, strict=True)
    ]
    return Mixture.assign_sequences(components, np.full(len(seeds), 1.0 / len(seeds)), data, priors)


def classification_em(
    mixture: Mixture, data: Sequences, priors: Priors, *, max_iter: int, tol: float
) -> Ascent[Mixture]:
    """Improve a mixture, ``max_iter`` times at most.

    Stops when an iteration raises the objective by less than ``tol`` per visible entry.
    """
    return ascend(
        mixture,
        lambda now: now.improve(data, priors),
        lambda now: now.objective,
        max_iter=max_iter,
        threshold=tol * data.counts.sum(),
    )
