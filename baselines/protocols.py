r"""The interface of models, and the abilities that a model may have.

A model is fitted to recordings, hidden entries included. What it can do and what it needs are
data: ``provides`` has the names of its abilities and ``needs`` those of its needs, all of which
`mocapbench.baselines.declarations` describes. Both are asked of an unfitted model, so that one that
wraps another may answer for it. A model inherits a class for each ability that it has:

* `Forecaster` continues recordings: it gives the mean, and optionally the variance, of
  :math:`p(y_{\text{hidden}} \mid y_{\text{visible}})` of the frames after the last visible one;
* `FrameImputer` fills frames that are hidden as a whole, and is therefore a `Forecaster`;
* `Imputer` fills any set of hidden entries, and is therefore a `FrameImputer`;
* `Inductive` is an imputer that also fills recordings that were not given to `fit`;
* `Interpolator` is an imputer that fills each channel from its own course alone;
* `Synthesiser` draws new recordings from :math:`p(y_{\text{new}} \mid y_{\text{visible}})`;
* `Clusterer` groups the recordings given to `fit`;
* `Aligner` maps the frames of recordings of a cyclic motion onto the states of one cycle;
* `Blender` mixes the styles that it has learnt;
* `Trended` infers a trend around which the recordings vary;
* `Layered` gives the covariance of each layer of a hierarchy, `Coregionalised` also the
  coregionalisation matrices;
* `Embedded` gives every frame a position in a latent space, and `Dynamical` draws trajectories
  through it.

Symbols in shapes: N frames, D channels, K recordings, M states of a cycle, C styles, Q components,
d latent dimensions, n samples.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import FunctionType
from typing import TYPE_CHECKING, Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mocapbench.basics.blas import limit_blas
from mocapbench.basics.numbers import real_numbers
from mocapbench.datasets import FrameByChannel, Frames, Recording

if TYPE_CHECKING:  # scikit-learn has no types, so that with its class those of all models are lost

    class BaseEstimator:
        """What models have of scikit-learn's estimators."""

        def get_params(self, deep: bool = True) -> dict[str, Any]: ...

        def set_params(self, **params: Any) -> Self: ...
else:
    from sklearn.base import BaseEstimator

__all__ = [
    "Aligner",
    "Blender",
    "Clusterer",
    "Coregionalised",
    "Dynamical",
    "Embedded",
    "Forecaster",
    "FrameByStyle",
    "FrameImputer",
    "Imputer",
    "Inductive",
    "Interpolator",
    "Layered",
    "Model",
    "Prediction",
    "SampleByFrameByChannel",
    "StatePath",
    "Synthesiser",
    "Trended",
]

StatePath = NDArray[np.intp]
"""(N,) the state 0 … M − 1 of the common cycle for each frame of a recording."""

FrameByStyle = NDArray[np.float64]
"""(N, C) one row a frame, one column a style."""

SampleByFrameByChannel = NDArray[np.float64]
"""(n, N, D) n sampled recordings."""


_ROUNDING = 3e-5
"""Variances below 0 by less than the square of this share of the largest mean are rounded ones."""


@dataclass(frozen=True, eq=False)
class Prediction:
    """A predictive distribution of the observations of one recording.

    Parameters
    ----------
    mean : ndarray of shape (N, D)
        Predictive mean at hidden entries; visible entries are copied.
    variance : ndarray of shape (N, D) or None, default=None
        Predictive variance of an observation, noise included; 0 at visible entries. None means
        that the model has no predictive distribution.

    Raises
    ------
    ValueError
        If they are not real numbers of one shape (N, D), or a variance is negative.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.baselines import Prediction
    >>> from mocapbench.datasets import Recording
    >>> recording = Recording("r", np.arange(3.0), [[1.0], [np.nan], [3.0]], ("knee",), ("deg",))
    >>> prediction = Prediction.around(recording, np.full((3, 1), 2.0), np.full((3, 1), 0.5))
    >>> prediction.mean[:, 0], prediction.variance[:, 0]
    (array([1., 2., 3.]), array([0. , 0.5, 0. ]))
    """

    mean: FrameByChannel
    variance: FrameByChannel | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "mean", real_numbers("the mean of a prediction", self.mean))
        if self.mean.ndim != 2:
            raise ValueError(
                f"expected a mean of shape (frames, channels), got shape {self.mean.shape}"
            )
        if self.variance is not None:
            variance = real_numbers("the variance of a prediction", self.variance)
            object.__setattr__(self, "variance", variance)
            self._check_variance(variance)

    def _check_variance(self, variance: FrameByChannel) -> None:
        if variance.shape != self.mean.shape:
            raise ValueError(
                f"expected a variance of the shape {self.mean.shape} of the mean, "
                f"got {variance.shape}"
            )
        least = np.fmin.reduce(variance, axis=None, initial=0.0)
        # Rounding may leave a difference of variances just below 0.
        if np.sqrt(-least) > _ROUNDING * np.fmax.reduce(np.abs(self.mean), axis=None, initial=0.0):
            raise ValueError(
                f"expected variances of at least 0, got {least:g}; give squares of deviations"
            )

    @classmethod
    def around(
        cls, recording: Recording, mean: FrameByChannel, variance: FrameByChannel | None = None
    ) -> Prediction:
        """Return a prediction with ``mean`` and ``variance`` at the hidden entries of a recording.

        Parameters
        ----------
        recording : Recording
            The recording to fill; its visible entries are copied, with variance 0.
        mean : array_like that broadcasts to (N, D)
            Predictive mean.
        variance : array_like that broadcasts to (N, D), or None, default=None
            Predictive variance, noise included.

        Raises
        ------
        ValueError
            If one of them has another shape or no real numbers, or a variance is negative.
        """
        visible = recording.visible
        return cls(
            np.where(visible, recording.values, _fitting("mean", mean, recording)),
            None
            if variance is None
            else np.where(visible, 0.0, _fitting("variance", variance, recording)),
        )


def _fitting(what: str, given: ArrayLike, recording: Recording) -> NDArray[np.float64]:
    """Return numbers that broadcast to the shape (N, D) of a recording."""
    values, shape = real_numbers(f"the {what} of a prediction", given), recording.values.shape
    sizes = zip(values.shape[::-1], shape[::-1], strict=False)
    if values.ndim > 2 or any(size not in (1, full) for size, full in sizes):
        raise ValueError(
            f"recording {recording.name!r}: expected a {what} that broadcasts to its shape {shape} "
            f"(frames, channels), got shape {values.shape}"
        )
    return values


class Model(BaseEstimator, ABC):
    """A scikit-learn estimator whose data are recordings.

    As in scikit-learn, ``__init__`` only stores its parameters, `fit` validates them and learns,
    and attributes that `fit` sets end with an underscore. Users implement the abilities below
    rather than this class.
    """

    family: ClassVar[str] = "Your models"
    """The rows of a report under which the model stands, beside others of its kind."""

    provides: ClassVar[frozenset[str]] = frozenset()
    """The names of its abilities: by default those of the classes that it inherits. A model that
    wraps another overrides it, and `needs`, by properties that return those of the other."""

    needs: ClassVar[frozenset[str]] = frozenset()
    """The names of what it needs besides recordings; ``fit`` receives some of it by keyword."""

    files_digest: ClassVar[str] = ""
    """A digest of what the model computes with besides Python code and recordings, such as programs
    and weights. If it changes, predictions are computed again."""

    def __init_subclass__(cls, **keywords: object) -> None:
        """Unite what the bases provide and need, and limit BLAS to one thread.

        The limit holds during every public method, those of mix-ins included.
        """
        super().__init_subclass__(**keywords)
        _unite_declarations(cls)
        for owner in cls.__mro__:
            if owner is cls or not (issubclass(owner, Model) or issubclass(Model, owner)):
                for name, method in _public_methods(owner):
                    if getattr(cls, name) is method:
                        setattr(cls, name, limit_blas(method))

    @abstractmethod
    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Learn from recordings.

        What is learnt follows from the recordings, the parameters and the seed alone. Where
        problems have these in common, a benchmark fits once, and hands copies of the fitted model
        (by ``pickle``) to all of them.

        Parameters
        ----------
        recordings : sequence of Recording
            At least one; all have the same channels and distinct names. Hidden entries are NaN.

        Returns
        -------
        Model
            The model itself.

        Raises
        ------
        ValueError
            If a parameter or the recordings are invalid.
        """


def _unite_declarations(model: type[Model]) -> None:
    """Let a model that inherits from several, and does not say otherwise, have what each has."""
    bases = [base for base in model.__bases__ if issubclass(base, Model)]
    for name in {"provides", "needs"} - {*vars(model)} if len(bases) > 1 else ():
        setattr(model, name, frozenset().union(*(getattr(base, name) for base in bases)))


def _public_methods(owner: type) -> list[tuple[str, FunctionType]]:
    return [
        (name, member)
        for name, member in vars(owner).items()
        if isinstance(member, FunctionType) and not name.startswith("_")
    ]


class Forecaster(Model):
    """A model that continues recordings: it fills the frames after the last visible one.

    Every frame up to that one, or the last few of them, is visible in all channels.
    """

    provides: ClassVar[frozenset[str]] = frozenset({"continues recordings"})

    @abstractmethod
    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return one prediction for each recording, in the given order.

        Parameters
        ----------
        recordings : sequence of Recording
            With the channels of those given to `fit`. Unless the model is `Inductive`, each must
            have been given to `fit` under the same name.

        Returns
        -------
        list of Prediction

        Raises
        ------
        ValueError
            If a recording cannot be filled.
        """


class FrameImputer(Forecaster):
    """A model that fills frames that are hidden as a whole.

    Every frame of a recording to fill is either visible or hidden in all channels. See `Imputer`
    for an example of an implementation.
    """

    provides: ClassVar[frozenset[str]] = Forecaster.provides | {"fills frames"}

    max_frames: ClassVar[int | None] = None
    """The most frames, all recordings together, that the model fills in some seconds; None is no
    limit. ``mocapbench fill`` gives it windows of longer recordings, around their gaps."""
    fill_cost: ClassVar[Mapping[str, float] | None] = None
    """What it costs to fit the model to a recording and fill it: the coefficient ``"seconds"`` and
    the exponents of a power law of the sizes of the problem, which are ``"frames"``,
    ``"channels"``, ``"gaps"``, ``"longest"`` (frames of the longest gap), ``"groups"`` (of channels
    that are hidden together) and ``"parts"`` (gaps of each channel beside visible ones); what is
    left out has the exponent 0. ``mocapbench fill`` decides by it whether there is time for the
    model. Models that were measured need none."""
    learns_in_fit: ClassVar[bool] = True
    """Whether `fit` learns anything. A model that only keeps the recordings, and learns when it
    fills one of them, is `Calibrated` by recordings held out besides: that costs nothing."""

    def impute_uncalibrated(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the predictions of `impute` before their variances are calibrated.

        Means are the same. Only `Calibrated`, and models built of calibrated ones, have another
        answer, which takes longer.
        """
        return self.impute(recordings)


class Imputer(FrameImputer):
    """A model that fills any set of hidden entries.

    Examples
    --------
    A model that fills hidden entries with the channel's mean over its training recordings:

    >>> import numpy as np
    >>> from mocapbench.baselines import Imputer, Inductive, Prediction
    >>> from mocapbench.datasets import Recording
    >>> class Mean(Imputer, Inductive):
    ...     def fit(self, recordings):
    ...         self.mean_ = np.nanmean(np.concatenate([r.values for r in recordings]), axis=0)
    ...         return self
    ...
    ...     def impute(self, recordings):
    ...         return [Prediction.around(recording, self.mean_) for recording in recordings]
    >>> recording = Recording("r", np.arange(3.0), [[1.0], [np.nan], [3.0]], ("knee",), ("deg",))
    >>> (prediction,) = Mean().fit([recording]).impute([recording])
    >>> prediction.mean[:, 0]
    array([1., 2., 3.])
    """

    provides: ClassVar[frozenset[str]] = FrameImputer.provides | {"fills entries"}


class Inductive(Model):
    """An imputer whose ``impute`` also takes recordings that were not given to ``fit``.

    It adds no method. See `Imputer` for an example.
    """

    provides: ClassVar[frozenset[str]] = frozenset({"fills new recordings"})


class Interpolator(Imputer):
    """An imputer that fills a channel from its visible entries in the same recording alone.

    Only where a channel has none in the recording may others help. Reports name the best such
    model beside every winner. It adds no method. See `Imputer` for an example.
    """

    provides: ClassVar[frozenset[str]] = Imputer.provides | {"interpolates"}

    family: ClassVar[str] = "Interpolation"


class Synthesiser(Model):
    """A model that draws new recordings.

    Examples
    --------
    A model that draws white noise around the training mean:

    >>> import numpy as np
    >>> from mocapbench.baselines import Synthesiser
    >>> from mocapbench.datasets import Recording
    >>> class WhiteNoise(Synthesiser):
    ...     def fit(self, recordings):
    ...         values = np.concatenate([recording.values for recording in recordings])
    ...         self.mean_, self.sd_ = np.nanmean(values, axis=0), np.nanstd(values, axis=0)
    ...         return self
    ...
    ...     def sample(self, times, n_samples, random_state):
    ...         rng = np.random.default_rng(random_state)
    ...         size = (n_samples, len(times), len(self.mean_))
    ...         return rng.normal(self.mean_, self.sd_, size)
    >>> recording = Recording("r", np.arange(3.0), [[1.0], [2.0], [3.0]], ("knee",), ("deg",))
    >>> WhiteNoise().fit([recording]).sample(np.arange(5.0), 2, random_state=0).shape
    (2, 5, 1)
    """

    provides: ClassVar[frozenset[str]] = frozenset({"draws samples"})

    @abstractmethod
    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return new recordings, noise included.

        Parameters
        ----------
        times : ndarray of shape (N,)
            In seconds, increasing.
        n_samples : int
            Number n of recordings.
        random_state : int or numpy.random.Generator
            Seed of the draws.

        Returns
        -------
        ndarray of shape (n, N, D)
            In the units of the recordings given to `fit`.
        """


class Clusterer(Model):
    """A model that groups the recordings given to ``fit``.

    Its constructor takes ``n_styles``, the largest number of clusters.

    Attributes
    ----------
    labels_ : ndarray of int, shape (K,)
        After `fit`, the cluster of each recording, in the order given. Recordings of the same
        cluster have equal labels.
    """

    provides: ClassVar[frozenset[str]] = frozenset({"clusters"})

    n_styles: int
    labels_: NDArray[np.intp]


class Aligner(Model):
    """A model that aligns recordings of a cyclic motion to one common cycle.

    Attributes
    ----------
    cycle_length_ : int
        After `fit`, the number of states M of the cycle.
    path_ : tuple of ndarray of int, each of shape (N_k,)
        After `fit`, the state 0 … M − 1 of each frame of each recording, in the order given.
    """

    provides: ClassVar[frozenset[str]] = frozenset({"aligns"})

    cycle_length_: int
    path_: tuple[StatePath, ...]

    @abstractmethod
    def align(self, recordings: Sequence[Recording]) -> list[StatePath]:
        """Return the state sequence of each recording.

        Parameters
        ----------
        recordings : sequence of Recording
            With the channels of those given to `fit`.

        Returns
        -------
        list of ndarray of int, each of shape (N_k,)
            The state 0 … M − 1 of each frame, in the order of the recordings.
        """


class Blender(Clusterer):
    """A clusterer whose styles can be mixed, because their cycles are synchronous."""

    provides: ClassVar[frozenset[str]] = Clusterer.provides | {"blends"}

    @abstractmethod
    def blend(self, weights: FrameByStyle) -> FrameByChannel:
        """Return a motion whose frame i is the mean of the styles' poses, weighted by row i.

        Parameters
        ----------
        weights : array_like of shape (N, n_styles)
            Non-negative, with rows that sum to 1; column c is the weight of the style with label c
            in ``labels_``.

        Returns
        -------
        ndarray of shape (N, D)
            N frames at the pace of the recordings given to `fit`, in their channels and units.
        """


class Trended(Model):
    """A model of recordings that vary around one trend."""

    provides: ClassVar[frozenset[str]] = frozenset({"has a trend"})

    @abstractmethod
    def trend(self, times: Frames) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the posterior mean and variance of the trend.

        Parameters
        ----------
        times : ndarray of shape (N,)
            In seconds.

        Returns
        -------
        mean, variance : ndarray of shape (N, D)
            In the units of the recordings, noise left out.
        """


class Layered(Model):
    """A model that gives the prior covariance of each layer of its hierarchy."""

    provides: ClassVar[frozenset[str]] = frozenset({"has layers"})

    @property
    @abstractmethod
    def layers(self) -> tuple[str, ...]:
        """After `fit`, the names of the layers, from the trend down to the single recording."""

    @abstractmethod
    def covariance(self, layer: str, times: Frames) -> NDArray[np.float64]:
        """Return the prior covariance of a layer, noise left out.

        Parameters
        ----------
        layer : str
            One of `layers`.
        times : ndarray of shape (N,)
            In seconds.

        Returns
        -------
        ndarray of shape (D N, D N)
            In the units of the recordings, outputs slowest.
        """


class Coregionalised(Layered):
    """A layered model whose layers are linear models of coregionalisation.

    Attributes
    ----------
    coregionalisation_ : mapping of str to ndarray of shape (Q, D, D)
        After `fit`, the matrices B_q of each layer, in the outputs' own units.
    """

    provides: ClassVar[frozenset[str]] = Layered.provides | {"has coregionalisation"}

    @property
    @abstractmethod
    def coregionalisation_(self) -> Mapping[str, NDArray[np.float64]]:
        """The matrices B_q of each layer, (Q, D, D), by the name of the layer."""


class Embedded(Model):
    """A model whose frames have positions in a latent space.

    Attributes
    ----------
    kernel_properties_ : mapping of str to float
        After `fit`, interpretable quantities of the kernels by name, such as lengthscales.
    """

    provides: ClassVar[frozenset[str]] = frozenset({"has a latent space"})

    kernel_properties_: Mapping[str, float]

    @abstractmethod
    def latent_paths(self) -> list[NDArray[np.float64]]:
        """Return the latent positions of each stretch of training frames.

        Returns
        -------
        list of ndarray, each of shape (N_p, d)
        """

    @abstractmethod
    def confidence(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return −ln of the predictive variance of poses, on the model's scale.

        Parameters
        ----------
        positions : ndarray of shape (n, d)

        Returns
        -------
        ndarray of shape (n,)
        """


class Dynamical(Embedded):
    """An embedded model with dynamics in its latent space."""

    provides: ClassVar[frozenset[str]] = Embedded.provides | {"has latent dynamics"}

    @abstractmethod
    def latent_walks(
        self, n_frames: int, n_samples: int, random_state: int | np.random.Generator
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return trajectories that start at the first training position.

        Parameters
        ----------
        n_frames, n_samples : int
            Numbers N of frames and n of samples.
        random_state : int or numpy.random.Generator
            Seed of the samples.

        Returns
        -------
        mean : ndarray of shape (N, d)
            The mean prediction.
        samples : ndarray of shape (n, N, d)
        """

    @abstractmethod
    def poses(self, positions: NDArray[np.float64]) -> FrameByChannel:
        """Return the mean poses (N, D) at the latent ``positions`` (N, d)."""
