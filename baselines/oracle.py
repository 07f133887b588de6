r"""The best possible model of toy data: the generating process with its true parameters.

The children are :math:`y_r = g + (f_r - g) + \varepsilon_r` with blocks
:math:`\operatorname{cov}(y_r, y_s) = K_g + \delta_{rs}(K_f + \sigma^2 I)`. Children with the same
visible entries form a *pattern*, of size :math:`R_p`. Their mean and the deviations from it are
independent, and only the mean depends on :math:`g`. The parent is therefore inferred from one mean
curve for each pattern, with covariance :math:`K_g + \delta_{pq}(K_f + \sigma^2 I)/R_p`.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_channels, check_outputs, check_recordings
from mocapbench.baselines.common.recordings import by_content
from mocapbench.baselines.common.validation import check_sampling, check_times
from mocapbench.baselines.protocols import (
    Imputer,
    Prediction,
    SampleByFrameByChannel,
    Synthesiser,
    Trended,
)
from mocapbench.basics.arrays import Array, Index
from mocapbench.datasets import FrameByChannel, Frames, Mask, Recording, ToyProcess
from mocapbench.datasets.process import draw_gaussian

__all__ = ["Oracle"]


class Oracle(Imputer, Synthesiser, Trended):
    r"""The true process itself, given all visible entries; the limit that models can reach.

    The recordings given to `fit` are children of one parent. `impute` gives the exact mean and
    variance of hidden observations, noise included, and `sample` exact draws of new children, both
    given the visible entries of all recordings.

    Attributes
    ----------
    process_ : ToyProcess
        The generating process, given to `fit`.
    times_ : ndarray of shape (N,)
        All times of the recordings; a curve on this grid is a vector (D N,), outputs slowest.

    Notes
    -----
    With the true covariance K of all entries, noise included, visible entries v and hidden entries
    h:

    .. math::

        E[y_h \mid y_v] = K_{hv} K_{vv}^{-1} y_v, \qquad
        \operatorname{cov}[y_h \mid y_v] = K_{hh} - K_{hv} K_{vv}^{-1} K_{vh}

    References
    ----------
    C. E. Rasmussen and C. K. I. Williams (2006), Gaussian Processes for Machine Learning, MIT
    Press, eq. (2.23) and (2.24): the conditional mean and covariance.

    J. D. Gil López (2017), Hierarchical Multiple Output Gaussian Processes for Human Motion Data,
    MSc thesis, Universidad Tecnológica de Pereira, §5.1.1 and eq. (16): the process.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import Oracle
    >>> from mocapbench.datasets import ToyProcess
    >>> rng = np.random.default_rng(0)
    >>> process = ToyProcess.random(rng, n_outputs=2, noise=0.01)
    >>> children = process.draw(rng, np.linspace(0.0, 6.0, 20), 3)
    >>> hidden = np.zeros((20, 2), dtype=bool)
    >>> hidden[10] = True
    >>> incomplete = children[0].hide(hidden)
    >>> model = Oracle().fit([incomplete, *children[1:]], process)
    >>> (prediction,) = model.impute([incomplete])
    >>> bool((np.abs(prediction.mean - children[0].values) < 0.5).all())
    True
    >>> bool((prediction.variance[10] > process.noise).all())
    True
    """

    family: ClassVar[str] = "References"

    needs: ClassVar[frozenset[str]] = frozenset({"true process"})

    def fit(self, recordings: Sequence[Recording], process: ToyProcess | None = None) -> Self:
        """Condition on the mean of each pattern.

        Parameters
        ----------
        recordings : sequence of Recording
        process : ToyProcess
            The process that generated them.

        Raises
        ------
        ValueError
            If no process is known, the recordings' channels differ or are not its outputs, a name
            repeats, or nothing is visible.
        """
        if process is None:
            raise ValueError("expected a process that generated the recordings, got None")
        self.process_ = process
        checked = by_content(check_recordings(recordings))
        check_outputs(checked, self.process_)
        self.channels_: tuple[str, ...] = checked[0].channels
        self.units_: tuple[str, ...] = checked[0].units
        self.times_: Array = np.unique(np.concatenate([recording.times for recording in checked]))
        self._parent = self.process_.parent.covariance(self.times_)
        self._within = self.process_.child.covariance(self.times_)
        self._within += self.process_.noise * np.eye(len(self._within))
        self._group(checked)
        self._condition()
        return self

    def _group(self, recordings: Sequence[Recording]) -> None:
        """Store the patterns, and for each recording its pattern and its row there."""
        groups: dict[bytes, list[Recording]] = defaultdict(list)
        for recording in recordings:
            groups[self._entries(recording, recording.visible).tobytes()].append(recording)
        # Where the visible entries (n,) of a pattern stand in a curve, and its values (R_p, n).
        self._patterns = [self._pattern(group) for group in groups.values()]
        self._places = {
            recording.name: (p, row)
            for p, group in enumerate(groups.values())
            for row, recording in enumerate(group)
        }

    def _pattern(self, group: Sequence[Recording]) -> tuple[Index, Array]:
        entries = self._entries(group[0], group[0].visible)
        values = [recording.values.T[recording.visible.T] for recording in group]
        return entries, np.stack(values)

    def _entries(self, recording: Recording, mask: Mask) -> Index:
        """Return where the entries under ``mask`` (N, D) stand in a curve."""
        columns = np.searchsorted(self.times_, recording.times)
        rows = len(self.times_) * np.arange(len(recording.channels))
        return np.asarray((rows[:, None] + columns)[mask.T])

    def _condition(self) -> None:
        """Factorise the covariance of the patterns' means."""
        sizes = [len(entries) for entries, _ in self._patterns]
        if not sum(sizes):
            raise ValueError("expected visible entries to condition on, got none")
        self._owner = np.repeat(np.arange(len(sizes)), sizes)
        self._seen = np.concatenate([entries for entries, _ in self._patterns])
        means = np.concatenate([values.mean(axis=0) for _, values in self._patterns])
        replicates = np.array([len(values) for _, values in self._patterns])[self._owner]
        block = np.ix_(self._seen, self._seen)
        same = self._owner[:, None] == self._owner
        # K_g + δ_pq (K_f + σ² I) / R_p
        covariance = self._parent[block] + np.where(same, self._within[block], 0.0) / replicates
        self._factor = cho_factor(covariance, lower=True)
        self._weights = cho_solve(self._factor, means)

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the exact conditional mean and variance of the hidden entries.

        Raises
        ------
        ValueError
            If a recording was not given to `fit`, or channels or units differ.
        """
        check_is_fitted(self, "times_")
        check_channels(recordings, self.channels_, self.units_)
        return [self._prediction(recording) for recording in recordings]

    def trend(self, times: Frames) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the exact conditional mean and variance of g at ``times`` (M,): (M, D) each."""
        check_is_fitted(self, "times_")
        times = check_times(times)
        mean, covariance = self._trend(times)
        shape = self.process_.n_outputs, len(times)
        return mean.reshape(shape).T, np.diag(covariance).reshape(shape).T

    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return new children of the same parent, given all visible entries: (n, N, D).

        The parent is drawn once from its posterior and shared by all; noise is included. ``times``
        may be in any order.

        Raises
        ------
        ValueError
            If times, the number of samples or the seed are invalid.
        """
        check_is_fitted(self, "times_")
        times = check_sampling(times, n_samples, random_state, increasing=False)
        rng = np.random.default_rng(random_state)
        mean, covariance = self._trend(times)
        within = self.process_.child.covariance(times)
        within += self.process_.noise * np.eye(len(within))
        curves = mean + draw_gaussian(rng, covariance, 1) + draw_gaussian(rng, within, n_samples)
        return curves.reshape(n_samples, self.process_.n_outputs, -1).transpose(0, 2, 1)

    def _trend(self, times: Frames) -> tuple[Array, Array]:
        """Return the parent's posterior mean (D M,) and covariance at ``times`` (M,)."""
        joint = self.process_.parent.covariance(np.concatenate([times, self.times_]))
        places = np.arange(len(joint)).reshape(self.process_.n_outputs, -1)
        new, known = places[:, : len(times)].ravel(), places[:, len(times) :].ravel()
        cross = joint[np.ix_(new, known[self._seen])]
        explained = cross @ cho_solve(self._factor, cross.T)
        return cross @ self._weights, joint[np.ix_(new, new)] - explained

    def _prediction(self, recording: Recording) -> Prediction:
        if recording.name not in self._places:
            raise ValueError(
                f"expected recordings given to fit, {sorted(self._places)}, got {recording.name!r}"
            )
        hidden = ~recording.visible
        mean, variance = np.zeros(hidden.shape), np.zeros(hidden.shape)
        mean.T[hidden.T], variance.T[hidden.T] = self._conditional(
            *self._places[recording.name], self._entries(recording, hidden)
        )
        return Prediction.around(recording, mean, variance)

    def _conditional(self, p: int, row: int, hidden: Index) -> tuple[Array, Array]:
        """Return mean and variance of the ``hidden`` entries of child ``row`` of pattern ``p``."""
        entries, values = self._patterns[p]
        size = len(values)
        within = self._within[np.ix_(hidden, self._seen)] * (self._owner == p)
        # The mean of its pattern: cov(y_h, ȳ_p) = K_g + δ (K_f + σ² I) / R_p.
        cross = self._parent[np.ix_(hidden, self._seen)] + within / size
        mean = cross @ self._weights
        variance = np.diag(self._parent)[hidden] + np.diag(self._within)[hidden]
        variance -= np.sum(cross * cho_solve(self._factor, cross.T).T, axis=1)

        # The contribution of the child's deviation from its pattern's mean; zero if R_p = 1.
        child = self._within[np.ix_(hidden, entries)]
        gain = np.linalg.solve(self._within[np.ix_(entries, entries)], child.T).T
        mean += gain @ (values[row] - values.mean(axis=0))
        variance -= (1 - 1 / size) * np.sum(gain * child, axis=1)
        return mean, variance
