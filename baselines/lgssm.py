"""Clusters of recordings, each with linear Gaussian dynamics of its own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.ascent import Ascent
from mocapbench.baselines.common.checks import check_recordings
from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.baselines.common.recordings import by_content, places_by_content
from mocapbench.baselines.common.scaling import Standardisation
from mocapbench.baselines.common.validation import check_count, check_positive, check_seed
from mocapbench.baselines.protocols import Clusterer
from mocapbench.baselines.state_space.expectation_maximisation import initial_states
from mocapbench.baselines.state_space.linear_gaussian import PRIORS
from mocapbench.baselines.state_space.mixture import Mixture, classification_em, seed_mixture
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Recording

__all__ = ["LGSSM"]


class LGSSM(Clusterer):
    r"""A linear dynamical system for each style; a recording joins the one that fits it best.

    Each component has the model of `LDS`, which integrates hidden entries out. Learning clusters
    the recordings and fits the components at the same time. It follows Chiappa, Kober and Peters,
    with three approximations: parameters are estimates under the weak priors of `LDS` (MAP), where
    the paper has a variational posterior; the number of states is given, where the paper prunes
    states by sparse priors; and each recording belongs to one component (classification EM), since
    with thousands of entries in a recording the probabilities of components are 0 or 1 in effect.

    Parameters
    ----------
    n_styles : int, default=4
        Largest number of clusters; the number of recordings, if that is smaller. Some may be empty.
    n_states : int, default=5
        Number of states of each component, as in `LDS`.
    n_restarts : int, default=3
        Number of starts, each from as many random recordings as there are clusters; the run with
        the highest objective is kept.
    max_iter : int, default=10
        Largest number of iterations of a run.
    tol : float, default=1e-3
        A run has converged when an iteration raises the objective by less than ``tol`` per
        visible entry.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the starts.

    Attributes
    ----------
    labels_ : ndarray of int, shape (K,)
        The cluster of each recording.
    mixture_ : Mixture
        The components, for standardised channels; its recordings are in the order of their values.
    objective_ : ndarray of shape (n_iterations + 1,)
        The objective of classification EM at the start and after each iteration.
    restart_objectives_ : ndarray of shape (n_restarts,)
        The final objective of each run.
    n_iterations_ : int
        Iterations of the run that was kept.
    converged_ : bool
        Whether that run converged.

    Notes
    -----
    With the parameters :math:`\theta_c` of component c, each a model as of `LDS`, their priors p,
    the probabilities :math:`\pi_c` of components, and the component :math:`c(k)` of recording
    :math:`Y_k`:

    .. math::

        \max_{c, \theta, \pi} \sum_k \bigl[ \log p(Y_k \mid \theta_{c(k)}) + \log \pi_{c(k)} \bigr]
        + \sum_c \bigl[ \log \pi_c + \log p(\theta_c) \bigr]

    References
    ----------
    S. Chiappa, J. Kober and J. Peters (2009), Using Bayesian Dynamical Systems for Motion Template
    Libraries, Advances in Neural Information Processing Systems 21.

    W. Pan and L. Torresani (2009), Unsupervised Hierarchical Modeling of Locomotion Styles, ICML,
    §4, "LGSSM".

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import LGSSM
    >>> from mocapbench.datasets import Recording
    >>> def swing(name, period):
    ...     angle = 2 * np.pi * np.arange(40) / period
    ...     values = np.column_stack([np.sin(angle), np.cos(angle)])
    ...     return Recording(name, np.arange(40) / 30, values, ("hip", "knee"), ("deg",) * 2)
    >>> swings = [swing("a", 20), swing("b", 5), swing("c", 20), swing("d", 5)]
    >>> labels = LGSSM(n_styles=2, n_states=2, random_state=0).fit(swings).labels_
    >>> bool(labels[0] == labels[2]), bool(labels[1] == labels[3]), bool(labels[0] == labels[1])
    (True, True, False)
    """

    family: ClassVar[str] = "State space"

    def __init__(
        self,
        n_styles: int = 4,
        *,
        n_states: int = 5,
        n_restarts: int = 3,
        max_iter: int = 10,
        tol: float = 1e-3,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_styles = n_styles
        self.n_states = n_states
        self.n_restarts = n_restarts
        self.max_iter = max_iter
        self.tol = tol
        self.random_state = random_state

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Cluster the recordings.

        Raises
        ------
        ValueError
            If a parameter is of the wrong type or out of range, there is no recording, channels
            differ, a name repeats, or a channel is nowhere visible.
        """
        self._check_parameters()
        checked = check_recordings(recordings)
        ordered = by_content(checked)
        self.scaling_: Standardisation = Standardisation.of(ordered)
        data = Sequences.of([self.scaling_.apply(recording).values for recording in ordered])
        states, rng = initial_states(data, self.n_states), np.random.default_rng(self.random_state)
        runs = [self._run(states, data, rng) for _ in range(self.n_restarts)]
        self.restart_objectives_: Array = np.array([run.state.objective for run in runs])
        best = runs[int(self.restart_objectives_.argmax())]
        self.mixture_: Mixture = best.state
        self.converged_: bool = best.converged
        self.objective_: Array = np.array(best.objectives)
        self.n_iterations_: int = best.n_iterations
        self.labels_: NDArray[np.intp] = best.state.labels[places_by_content(checked)]
        return self

    def _check_parameters(self) -> None:
        for name in ("n_styles", "n_states", "n_restarts", "max_iter"):
            check_count(name, getattr(self, name), 1)
        check_positive("tol", self.tol)
        check_seed("random_state", self.random_state)

    def _run(self, states: Array, data: Sequences, rng: np.random.Generator) -> Ascent[Mixture]:
        n_sequences = len(data.lengths)
        seeds = rng.choice(n_sequences, min(self.n_styles, n_sequences), replace=False)
        return classification_em(
            seed_mixture(states, data, seeds, PRIORS),
            data,
            PRIORS,
            max_iter=self.max_iter,
            tol=self.tol,
        )
