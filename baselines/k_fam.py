"""K-means on cycles from the functional analysis of motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.cycle_settings import check_settings
from mocapbench.baselines.common.prototypes import cluster_cycles
from mocapbench.baselines.fam import FAM
from mocapbench.baselines.protocols import Aligner, Clusterer, StatePath
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Recording

__all__ = ["KFAM"]


class KFAM(Clusterer, Aligner):
    r"""Cluster recordings by their cycles as `FAM` describes them (K-means).

    Parameters
    ----------
    n_styles : int, default=4
        Number of clusters; the number of recordings, if that is smaller.
    n_components, n_harmonics : int, default=3 and 6
        As in `FAM`.
    smoothness : float, default=0.1
        As in `FAM`.
    n_restarts : int, default=1
        Number of starts of FAM's alignment, and of K-means.
    max_iter : int, default=30
        As in `FAM`.
    tol : float, default=1e-4
        As in `FAM`.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the starts of both.

    Attributes
    ----------
    labels_ : ndarray of int, shape (K,)
        The cluster of each recording.
    cycles_ : ndarray of shape (C, M, D)
        The mean cycle of each cluster, the style's prototype.
    path_ : tuple of ndarray of int, each of shape (N_k,)
        The state of each frame of each recording.
    cycle_length_ : int
        Number M of states.
    fam_ : FAM
        The fitted model of the cycles.

    Notes
    -----
    With the mean cycle :math:`P_k` of recording k, in standard units, K-means chooses clusters c
    and their means C:

    .. math:: \min_{c, C} \sum_k \| P_k - C_{c(k)} \|^2

    References
    ----------
    W. Pan and L. Torresani (2009), Unsupervised Hierarchical Modeling of Locomotion Styles, ICML,
    §4, "K-FAM".

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import KFAM
    >>> from mocapbench.datasets import Recording
    >>> def walk(name, size):
    ...     angle = 2 * np.pi * np.arange(40) / 10
    ...     values = size * np.column_stack([np.sin(angle), np.cos(angle)])
    ...     return Recording(name, np.arange(40) / 30, values, ("hip", "knee"), ("deg",) * 2)
    >>> walks = [walk("a", 1.0), walk("b", 1.1), walk("c", 5.0)]
    >>> model = KFAM(n_styles=2, random_state=0).fit(walks)
    >>> bool(model.labels_[0] == model.labels_[1]), bool(model.labels_[0] == model.labels_[2])
    (True, False)
    """

    family: ClassVar[str] = "Functional"

    def __init__(
        self,
        n_styles: int = 4,
        *,
        n_components: int = 3,
        n_harmonics: int = 6,
        smoothness: float = 0.1,
        n_restarts: int = 1,
        max_iter: int = 30,
        tol: float = 1e-4,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_styles = n_styles
        self.n_components = n_components
        self.n_harmonics = n_harmonics
        self.smoothness = smoothness
        self.n_restarts = n_restarts
        self.max_iter = max_iter
        self.tol = tol
        self.random_state = random_state

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Align the recordings and fill their cycles, then cluster these.

        Raises
        ------
        ValueError
            As `FAM.fit`, or if ``n_styles`` is not a positive integer.
        """
        check_settings(self.get_params())
        rng = np.random.default_rng(self.random_state)
        parameters = {k: v for k, v in self.get_params().items() if k != "n_styles"}
        self.fam_: FAM = FAM(**{**parameters, "random_state": rng}).fit(recordings)
        self.path_: tuple[StatePath, ...] = self.fam_.path_
        self.cycle_length_: int = self.fam_.cycle_length_
        labels, cycles = cluster_cycles(
            self.fam_.prototypes_, self.fam_.scaling_.scale, self.n_styles, self.n_restarts, rng
        )
        self.labels_: NDArray[np.intp] = labels
        self.cycles_: Array = cycles
        return self

    def align(self, recordings: Sequence[Recording]) -> list[StatePath]:
        """Return the state of each frame of recordings, as `FAM.align`.

        Raises
        ------
        ValueError
            If channels differ, or a recording has no frame.
        """
        check_is_fitted(self)
        return self.fam_.align(recordings)
