"""K-means on cycles that are aligned by the continuous profile model."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_recordings
from mocapbench.baselines.common.cycle_settings import check_settings
from mocapbench.baselines.common.prototypes import cluster_cycles
from mocapbench.baselines.cpm import CPM
from mocapbench.baselines.protocols import Aligner, Clusterer, StatePath
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Recording

__all__ = ["KCPM"]


class KCPM(Clusterer, Aligner):
    r"""Cluster recordings by their cycles as `CPM` aligns them (K-means).

    Parameters
    ----------
    n_styles : int, default=4
        Number of clusters; the number of recordings, if that is smaller.
    n_states : int or None, default=None
        Number M of states, at least ``2 * max_jump + 1``. None means two for each frame of a
        cycle, whose length is estimated by autocorrelation.
    max_jump : int, default=3
        Largest number of states between consecutive frames.
    n_restarts : int, default=1
        Number of runs of CPM, and of K-means.
    max_iter : int, default=60
        Largest number of iterations of a run of CPM.
    tol : float, default=1e-5
        Convergence threshold of CPM, as in `CPM`.
    regularisation : float, default=0.1
        Weight of the penalties of CPM, as in `CPM`.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the starts of both.

    Attributes
    ----------
    labels_ : ndarray of int, shape (K,)
        The cluster of each recording.
    cycles_ : ndarray of shape (C, M, D)
        The mean cycle of each cluster, the style's prototype.
    path_ : tuple of ndarray of int, each of shape (N_k,)
        The most likely state sequence of each recording (Viterbi).
    cycle_length_ : int
        Number M of states.
    cpm_ : CPM
        The fitted model of the alignment.

    Notes
    -----
    With the aligned cycle :math:`P_k` of recording k, in standard units, K-means chooses clusters c
    and their means C:

    .. math:: \min_{c, C} \sum_k \| P_k - C_{c(k)} \|^2

    References
    ----------
    W. Pan and L. Torresani (2009), Unsupervised Hierarchical Modeling of Locomotion Styles, ICML,
    §4, "K-CPM".

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import KCPM
    >>> from mocapbench.datasets import Recording
    >>> def walk(name, size):
    ...     angle = 2 * np.pi * np.arange(40) / 10
    ...     values = size * np.column_stack([np.sin(angle), np.cos(angle)])
    ...     return Recording(name, np.arange(40) / 30, values, ("hip", "knee"), ("deg",) * 2)
    >>> walks = [walk("a", 1.0), walk("b", 1.1), walk("c", 5.0)]
    >>> model = KCPM(n_styles=2, n_states=16, random_state=0).fit(walks)
    >>> bool(model.labels_[0] == model.labels_[1]), bool(model.labels_[0] == model.labels_[2])
    (True, False)
    """

    family: ClassVar[str] = "Alignment"

    def __init__(
        self,
        n_styles: int = 4,
        *,
        n_states: int | None = None,
        max_jump: int = 3,
        n_restarts: int = 1,
        max_iter: int = 60,
        tol: float = 1e-5,
        regularisation: float = 0.1,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_styles = n_styles
        self.n_states = n_states
        self.max_jump = max_jump
        self.n_restarts = n_restarts
        self.max_iter = max_iter
        self.tol = tol
        self.regularisation = regularisation
        self.random_state = random_state

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Align the recordings, then cluster their cycles.

        Raises
        ------
        ValueError
            As `CPM.fit`, or if ``n_styles`` is not a positive integer.
        """
        check_settings(self.get_params())
        checked = check_recordings(recordings)
        rng = np.random.default_rng(self.random_state)
        parameters = {k: v for k, v in self.get_params().items() if k != "n_styles"}
        self.cpm_: CPM = CPM(**{**parameters, "random_state": rng}).fit(checked)
        self.path_: tuple[StatePath, ...] = self.cpm_.path_
        self.cycle_length_: int = self.cpm_.cycle_length_
        labels, cycles = cluster_cycles(
            self.cpm_.prototypes_, self.cpm_.scaling_.scale, self.n_styles, self.n_restarts, rng
        )
        self.labels_: NDArray[np.intp] = labels
        self.cycles_: Array = cycles
        return self

    def align(self, recordings: Sequence[Recording]) -> list[StatePath]:
        """Return the most likely state sequence of each recording, as `CPM.align`.

        Raises
        ------
        ValueError
            If channels differ.
        """
        check_is_fitted(self)
        return self.cpm_.align(recordings)
