"""Functional analysis of cyclic motion: a mean cycle and principal components, with gaps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from mocapbench.baselines.common.checks import check_given, check_recordings
from mocapbench.baselines.common.cycle_settings import check_settings
from mocapbench.baselines.common.recordings import by_content, places_by_content
from mocapbench.baselines.common.scaling import Standardisation
from mocapbench.baselines.functional.components import (
    cycle_moments,
    find_principal_axes,
    fit_components,
    infer_scores,
    prototypes,
    sample_curves,
    start_components,
)
from mocapbench.baselines.functional.cycle_period import cycle_periods, elapsed_times, frame_step
from mocapbench.baselines.functional.fourier_series import CurveStatistics
from mocapbench.baselines.functional.phases import (
    SHIFTS,
    cut_cycles,
    place_recording,
    shift_together,
)
from mocapbench.baselines.protocols import Aligner, Imputer, Inductive, Prediction, StatePath
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Recording

__all__ = ["FAM"]


_SAME = 1.0 + 1e-9
"""Objectives whose ratio is below it are the same but for rounding."""


class FAM(Imputer, Inductive, Aligner):
    r"""A smooth mean cycle, and a few components by which single cycles differ from it.

    A recording is folded at the length of cycle with the highest signal-to-noise ratio, and shifted
    in phase to a reference curve, which is refitted in turn. Its cycles are then a mean curve plus
    a few components, all of them Fourier series with a penalty on curvature, plus noise with one
    variance for each channel. Scores of the components are standard normal and independent between
    cycles; they are integrated out, and hidden entries with them. The model works on channels of
    zero mean and unit variance. A recording in which no length of cycle stands out takes the median
    length; if that is so for all, each recording is one cycle.

    Parameters
    ----------
    n_components : int, default=3
        Number Q of components; one less than the number of cycles, if that is smaller. 0 leaves the
        mean curve.
    n_harmonics : int, default=6
        Number H of harmonics of the Fourier series.
    smoothness : float, default=0.1
        Weight :math:`\lambda` of the penalty :math:`\tfrac12 \lambda \sum_h h^4 (a_h^2 + b_h^2)` on
        mean and components, in standardised units.
    n_restarts : int, default=3
        Number of recordings, drawn at random, that serve in turn as the first reference curve (all,
        if there are fewer); the alignment with the least penalised squared error is kept.
    max_iter : int, default=30
        Largest number of rounds of filling and estimating again.
    tol : float, default=1e-4
        A fit has converged when a round raises the penalised log-likelihood by less than
        ``tol`` per visible entry.
    random_state : int, numpy.random.Generator or None, default=None
        Seed of the first reference curves.

    Attributes
    ----------
    recordings_ : tuple of Recording
        The recordings given to `fit`.
    periods_ : ndarray of shape (K,)
        Length of a cycle of each recording, in seconds.
    offsets_ : ndarray of shape (K,)
        Phase of the first frame of each recording, in cycles.
    cycle_length_ : int
        Number M of states of the cycle, two for each frame of a cycle of median length.
    path_ : tuple of ndarray of int, each of shape (N_k,)
        The state of each frame of each recording.
    mean_cycle_ : ndarray of shape (M, D)
        The mean curve.
    components_ : ndarray of shape (Q, M, D)
        The components, each times its standard deviation, the one of most variance first.
    prototypes_ : ndarray of shape (K, M, D)
        The mean of each recording's cycles, hidden entries filled.
    log_likelihood_ : ndarray of shape (n_iterations + 1,)
        The penalised log-likelihood at the start and after each round, for standardised channels.
    n_iterations_ : int
        Number of rounds.
    converged_ : bool
        Whether the fit converged.

    Notes
    -----
    With the Fourier basis b(u) of the phase u, and scores :math:`s_j` of cycle j:

    .. math::

        x_{jd}(u) = b(u)^\top \Bigl(m_d + \sum_q s_{jq} w_{qd}\Bigr) + \varepsilon, \qquad
        s_j \sim N(0, I), \quad \varepsilon \sim N(0, \sigma_d^2)

    ``docs/mathematics/functional.md`` has the algorithm.

    References
    ----------
    D. Ormoneit, M. J. Black, T. Hastie and H. Kjellström (2005), Representing cyclic human motion
    using functional analysis, Image and Vision Computing 23. ``docs/mathematics/functional.md``
    lists what differs.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import FAM
    >>> from mocapbench.datasets import Recording
    >>> def walk(name, n_frames, period):
    ...     angle = 2 * np.pi * np.arange(n_frames) / period
    ...     values = np.column_stack([np.sin(angle), np.cos(angle)])
    ...     return Recording(name, np.arange(n_frames) / 30, values, ("hip", "knee"), ("deg",) * 2)
    >>> walks = [walk("slow", 50, 15), walk("fast", 40, 12)]
    >>> model = FAM(random_state=0).fit(walks)
    >>> (30 * model.periods_).round(2)
    array([15., 12.])
    >>> hidden = np.zeros((40, 2), dtype=bool)
    >>> hidden[10:25, 0] = True
    >>> (prediction,) = model.impute([walks[1].hide(hidden)])
    >>> bool(np.abs(prediction.mean - walks[1].values).max() < 0.1)
    True
    """

    family: ClassVar[str] = "Functional"
    provides: ClassVar[frozenset[str]] = (
        Imputer.provides | Inductive.provides | Aligner.provides | {"scales along"}
    )

    def __init__(
        self,
        *,
        n_components: int = 3,
        n_harmonics: int = 6,
        smoothness: float = 0.1,
        n_restarts: int = 3,
        max_iter: int = 30,
        tol: float = 1e-4,
        random_state: int | np.random.Generator | None = None,
    ) -> None:
        self.n_components = n_components
        self.n_harmonics = n_harmonics
        self.smoothness = smoothness
        self.n_restarts = n_restarts
        self.max_iter = max_iter
        self.tol = tol
        self.random_state = random_state

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Estimate lengths, shifts, mean and components.

        Raises
        ------
        ValueError
            If a parameter is of the wrong type or out of range, there is no recording, a recording
            has no frame, channels differ, a name repeats, or a channel is nowhere visible.
        """
        check_settings(self.get_params())
        self.recordings_: tuple[Recording, ...] = check_recordings(recordings)
        self.channels_: tuple[str, ...] = self.recordings_[0].channels
        self.units_: tuple[str, ...] = self.recordings_[0].units
        ordered, places = by_content(self.recordings_), places_by_content(self.recordings_)
        self.scaling_: Standardisation = Standardisation.of(ordered)
        scaled = [self.scaling_.apply(recording) for recording in ordered]
        periods = cycle_periods(scaled)
        reference, shifts = self._shift_together(scaled, periods)
        self.reference_: Array = reference
        phases = [
            SHIFTS[shift] + elapsed_times(recording) / period
            for shift, recording, period in zip(shifts, scaled, periods, strict=True)
        ]
        self.cycle_length_: int = self._n_states(scaled, periods)
        self.periods_: Array = periods[places]
        self.offsets_: Array = SHIFTS[shifts][places]
        self.path_: tuple[StatePath, ...] = tuple(self._states(phases[k]) for k in places)
        self._learn(*cut_cycles(scaled, phases), places)
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return mean and variance of hidden entries, given the visible ones of the same cycle.

        A recording takes the length of cycle and the shift at which its visible entries are closest
        to the reference curve. The length is at most a quarter beyond those of the fitted ones.

        Raises
        ------
        ValueError
            If channels differ, or a recording has no frame.
        """
        check_given(self, recordings)
        return [self._fill_recording(recording) for recording in recordings]

    def align(self, recordings: Sequence[Recording]) -> list[StatePath]:
        """Return the state of each frame of recordings, which are placed as by `impute`.

        Raises
        ------
        ValueError
            If channels differ, or a recording has no frame.
        """
        check_given(self, recordings)
        return [self._states(self._place_recording(recording)) for recording in recordings]

    def _shift_together(
        self, scaled: Sequence[Recording], periods: Array
    ) -> tuple[Array, NDArray[np.intp]]:
        """Return the reference curve, and the shift of each recording to it."""
        curves = [
            (elapsed_times(recording) / period, recording.values)
            for recording, period in zip(scaled, periods, strict=True)
        ]
        statistics = CurveStatistics.of(curves, self.n_harmonics)
        rng = np.random.default_rng(self.random_state)
        firsts = rng.permutation(len(scaled))[: self.n_restarts]
        runs = [shift_together(statistics, int(first), self.smoothness) for first in firsts]
        least = min(objectives[-1] for *_, objectives in runs)
        # Runs often end alike but for a shift of all recordings: rounding must not choose.
        return next(
            (curve, shifts) for curve, shifts, course in runs if course[-1] <= least * _SAME
        )

    def _learn(
        self,
        cycles: Sequence[tuple[Array, Array]],
        owners: NDArray[np.intp],
        places: NDArray[np.intp],
    ) -> None:
        """Set the mean, the components and, of the recordings at ``places`` (K,), prototypes."""
        statistics = CurveStatistics.of(cycles, self.n_harmonics)
        n_components = min(self.n_components, len(owners) - 1)
        fit = fit_components(
            statistics,
            start_components(statistics, self.reference_, n_components, self.smoothness),
            self.smoothness,
            max_iter=self.max_iter,
            tol=self.tol,
        )
        self.log_likelihood_: Array = np.array(fit.objectives)
        self.converged_: bool = fit.converged
        self.n_iterations_: int = fit.n_iterations
        self.coefficients_: Array = find_principal_axes(fit.state.coefficients)
        self.noise_: Array = fit.state.noise
        curves = sample_curves(self.coefficients_, self.cycle_length_)
        self.mean_cycle_: Array = self.scaling_.restore(curves[0])
        self.components_: Array = curves[1:] * self.scaling_.scale
        cycle = prototypes(fit.state, statistics.counts.sum(axis=1), owners)[places]
        self.prototypes_: Array = self.scaling_.restore(sample_curves(cycle, self.cycle_length_))

    def _n_states(self, scaled: Sequence[Recording], periods: Array) -> int:
        """Return two states a frame of a cycle, but at least one for each coefficient."""
        steps = [frame_step(recording) for recording in scaled]
        return max(2 * round(float(np.median(periods / steps))), 2 * self.n_harmonics + 1)

    def _states(self, phases: Array) -> StatePath:
        states = np.floor(phases % 1.0 * self.cycle_length_).astype(np.intp)
        return np.asarray(states % self.cycle_length_)

    def _place_recording(self, recording: Recording) -> Array:
        return place_recording(self.scaling_.apply(recording), self.reference_, self.periods_)

    def _fill_recording(self, recording: Recording) -> Prediction:
        scaled = self.scaling_.apply(recording)
        curves, _ = cut_cycles([scaled], [self._place_recording(recording)])
        statistics = CurveStatistics.of(curves, self.n_harmonics)
        fit = infer_scores(statistics, self.coefficients_, self.noise_)
        mean, variance = cycle_moments([phases for phases, _ in curves], fit)
        return Prediction.around(
            recording, self.scaling_.restore(mean), variance * self.scaling_.scale**2
        )
