"""A linear dynamical system learnt by EM."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import ClassVar, Self

import numpy as np
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_given, check_recordings
from mocapbench.baselines.common.padded_sequences import Sequences
from mocapbench.baselines.common.recordings import by_content
from mocapbench.baselines.common.scaling import Standardisation
from mocapbench.baselines.common.validation import check_count, check_positive, check_sampling
from mocapbench.baselines.protocols import (
    Imputer,
    Inductive,
    Prediction,
    SampleByFrameByChannel,
    Synthesiser,
)
from mocapbench.baselines.state_space.expectation_maximisation import (
    expectation_maximisation,
    initial_states,
    show_noise,
    start_parameters,
)
from mocapbench.baselines.state_space.kalman import smooth_states
from mocapbench.baselines.state_space.linear_gaussian import (
    PRIORS,
    StateSpaceParameters,
    draw_sequences,
    entry_moments,
)
from mocapbench.basics.arrays import Array
from mocapbench.datasets import Frames, Recording

__all__ = ["LDS"]


class LDS(Imputer, Inductive, Synthesiser):
    r"""A few hidden states that move linearly over time, and channels linear in them.

    .. math:: x_{t+1} = A x_t + w_t, \qquad y_t = C x_t + d + v_t,

    with Gaussian noise, independent between channels in :math:`v_t`. All recordings share the
    parameters, which EM learns with the Kalman filter and the smoother of Rauch, Tung and Striebel.
    Hidden entries are integrated out. The model works on channels of zero mean and unit variance,
    and on frames at equal intervals. Weak priors keep the noise from vanishing (MAP).

    Recordings are filled by the smoother with the learnt parameters, so that one that was not given
    to `fit` is filled in the same way.

    Parameters
    ----------
    n_states : int, default=15
        Number q of states. A smaller number is taken, with a warning, where short stretches of the
        training frames have fewer dimensions. ``docs/mathematics/state-space.md`` has the choice of
        15.
    max_iter : int, default=10
        Largest number of iterations of EM.
    tol : float, default=1e-3
        EM has converged when an iteration raises the objective by less than ``tol`` per
        visible entry.

    Attributes
    ----------
    recordings_ : tuple of Recording
        The recordings given to `fit`.
    parameters_ : StateSpaceParameters
        The learnt parameters, for standardised channels.
    n_states_ : int
        The number of states.
    objective_ : ndarray of shape (n_iterations + 1,)
        Log-likelihood plus log-prior at the start and after each iteration, for standardised
        channels.
    n_iterations_ : int
        Number of iterations.
    converged_ : bool
        Whether EM converged.

    References
    ----------
    R. H. Shumway and D. S. Stoffer (1982), An Approach to Time Series Smoothing and Forecasting
    Using the EM Algorithm, Journal of Time Series Analysis 3(4).

    Z. Ghahramani and G. E. Hinton (1996), Parameter Estimation for Linear Dynamical Systems,
    University of Toronto, CRG-TR-96-2.

    L. Li, J. McCann, N. Pollard and C. Faloutsos (2009), DynaMMo: Mining and Summarization of
    Coevolving Sequences with Missing Values, KDD.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import LDS
    >>> from mocapbench.datasets import Recording
    >>> def swing(name, phase):
    ...     angle = 2 * np.pi * np.arange(40) / 10 + phase
    ...     values = np.column_stack([np.sin(angle), np.cos(angle)])
    ...     return Recording(name, np.arange(40) / 30, values, ("hip", "knee"), ("deg",) * 2)
    >>> model = LDS(n_states=2).fit([swing("a", 0.0), swing("b", 1.0)])
    >>> bool((np.diff(model.objective_) >= 0).all())
    True
    >>> hidden = np.zeros((40, 2), dtype=bool)
    >>> hidden[10:20] = True
    >>> new = swing("new", 2.0)
    >>> (prediction,) = model.impute([new.hide(hidden)])
    >>> bool(np.abs(prediction.mean - new.values).max() < 0.2)
    True
    """

    family: ClassVar[str] = "State space"
    provides: ClassVar[frozenset[str]] = (
        Imputer.provides | Inductive.provides | Synthesiser.provides | {"scales along"}
    )

    def __init__(self, n_states: int = 15, *, max_iter: int = 10, tol: float = 1e-3) -> None:
        self.n_states = n_states
        self.max_iter = max_iter
        self.tol = tol

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Learn the parameters from the visible entries.

        Raises
        ------
        ValueError
            If a parameter is of the wrong type or out of range, there is no recording, channels
            differ, a name repeats, or a channel is nowhere visible.
        """
        check_count("n_states", self.n_states, 1)
        check_count("max_iter", self.max_iter, 1)
        check_positive("tol", self.tol)
        self.recordings_: tuple[Recording, ...] = by_content(check_recordings(recordings))
        self.channels_: tuple[str, ...] = self.recordings_[0].channels
        self.units_: tuple[str, ...] = self.recordings_[0].units
        self.scaling_: Standardisation = Standardisation.of(self.recordings_)
        data = self._observations(self.recordings_)
        first = start_parameters(initial_states(data, self.n_states), data, PRIORS)
        run = expectation_maximisation(first, data, PRIORS, max_iter=self.max_iter, tol=self.tol)
        self.parameters_: StateSpaceParameters = run.state[0]
        self.converged_: bool = run.converged
        self.objective_: Array = np.array(run.objectives)
        self.n_iterations_: int = run.n_iterations
        self.n_states_: int = self.parameters_.n_states
        self._data = data
        self.__dict__.pop("_with_noise_shown", None)  # that of an earlier fit
        return self

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return mean and variance of the hidden entries given the visible ones of each recording.

        They are those of the smoother.

        Raises
        ------
        ValueError
            If channels differ.
        """
        check_given(self, recordings)
        return self._smooth_recordings(recordings, self.parameters_)

    def least_variances(self, recordings: Sequence[Recording]) -> list[Array]:
        """Return the variances (N, D) with as much noise as the entries learnt from show.

        The prior adds ten frames that are all noise. Where there is little of it, most of the
        predicted variance is that prior.
        """
        check_given(self, recordings)
        predictions = self._smooth_recordings(recordings, self._with_noise_shown)
        return [np.asarray(prediction.variance) for prediction in predictions]

    @cached_property
    def _with_noise_shown(self) -> StateSpaceParameters:
        """The parameters with the noise that the data show, found when it is asked for."""
        return show_noise(self.parameters_, self._data)

    def _smooth_recordings(
        self, recordings: Sequence[Recording], parameters: StateSpaceParameters
    ) -> list[Prediction]:
        if not len(recordings):
            return []
        data = self._observations(recordings)
        states = smooth_states(parameters, data)
        mean, variance = entry_moments(parameters, states.mean, states.covariance)
        means = map(self.scaling_.restore, data.unpad(mean))
        variances = data.unpad(variance * self.scaling_.scale**2)
        return list(map(Prediction.around, recordings, means, variances))

    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Draw recordings from the distribution of the first state on, noise included: (n, N, D).

        Of ``times`` (N,) only the number counts: frames are at the interval of the fitted ones.

        Raises
        ------
        ValueError
            If times do not increase, or the number of samples or the seed is invalid.
        """
        check_is_fitted(self)
        times = check_sampling(times, n_samples, random_state)
        rng = np.random.default_rng(random_state)
        return self.scaling_.restore(draw_sequences(self.parameters_, n_samples, len(times), rng))

    def _observations(self, recordings: Sequence[Recording]) -> Sequences:
        return Sequences.of([self.scaling_.apply(recording).values for recording in recordings])
