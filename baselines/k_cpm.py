"""Styles as clusters of the cycles that the continuous profile model warps recordings to."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import numpy as np
from numpy.typing import NDArray
from sklearn.cluster import KMeans
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.alignment.validation import check_settings
from mocapbench.baselines.common.recordings import check_recordings
from mocapbench.baselines.cpm import CPM
from mocapbench.baselines.protocols import Aligner, Clusterer, StatePath
from mocapbench.datasets import Recording

__all__ = ["KCPM"]


class KCPM(Clusterer, Aligner):
    """K-means on the prototypical cycles of `CPM`, standardised per channel.

    Parameters
    ----------
    n_styles : int, default=4
        Number of clusters; as many as there are recordings, if they are fewer.
    n_states, max_jump, max_iter, tolerance, regularisation
        As `CPM`.
    n_restarts : int, default=1
        Number of runs of CPM, and of K-means.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of both.

    Attributes
    ----------
    labels_ : ndarray of int, shape (K,)
        The cluster of each recording.
    cycles_ : ndarray of shape (C, M, D)
        The mean cycle of each cluster, the style's prototype.
    path_, cycle_length_ : tuple of ndarray of int, int
        The alignment, as of `CPM`.
    cpm_ : CPM
        The model that aligns.

    References
    ----------
    HLM §4, "K-CPM".
    """

    def __init__(
        self,
        n_styles: int = 4,
        *,
        n_states: int | None = None,
        max_jump: int = 3,
        n_restarts: int = 1,
        max_iter: int = 60,
        tolerance: float = 1e-5,
        regularisation: float = 0.1,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_styles = n_styles
        self.n_states = n_states
        self.max_jump = max_jump
        self.n_restarts = n_restarts
        self.max_iter = max_iter
        self.tolerance = tolerance
        self.regularisation = regularisation
        self.random_state = random_state

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Align the recordings, then cluster their cycles.

        Raises
        ------
        ValueError
            As `CPM.fit`, or if ``n_styles`` is not a positive integer.
        """
        check_settings(**self.get_params())
        checked = check_recordings(recordings)
        rng = np.random.default_rng(self.random_state)
        parameters = {k: v for k, v in self.get_params().items() if k != "n_styles"}
        self.cpm_ = CPM(**{**parameters, "random_state": rng}).fit(checked)
        self.path_, self.cycle_length_ = self.cpm_.path_, self.cpm_.cycle_length_
        cycles = self.cpm_.prototypes_ / self.cpm_.scaling_.scale
        means = KMeans(
            min(self.n_styles, len(checked)),
            n_init=self.n_restarts,
            random_state=int(rng.integers(2**31)),
        ).fit(cycles.reshape(len(cycles), -1))
        self.labels_: NDArray[np.intp] = means.labels_.astype(np.intp)
        self.cycles_ = np.stack(
            [self.cpm_.prototypes_[self.labels_ == c].mean(axis=0) for c in np.unique(self.labels_)]
        )
        return self

    def align(self, recordings: Sequence[Recording]) -> list[StatePath]:
        """Return the likeliest path of each recording along the trace, as `CPM.align`.

        Raises
        ------
        ValueError
            If channels differ.
        """
        check_is_fitted(self)
        return self.cpm_.align(recordings)
