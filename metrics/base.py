"""Metrics, and the outcomes that they score."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property
from numbers import Real
from types import MappingProxyType
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mocapbench.metrics.poses import ImputedPoses, SampledPoses, lock_fields, read_only

__all__ = [
    "Clustering",
    "Direction",
    "Imputation",
    "Metric",
    "Recovery",
    "Score",
    "Synthesis",
    "has_poses",
]

Array = NDArray[np.float64]


class Direction(Enum):
    """Which values of a metric are better: lower, higher, or nearer to a target."""

    LOWER = "lower"
    HIGHER = "higher"
    TARGET = "target"

    def loss(self, value: float, target: float | None) -> float:
        """Return ``value`` as a loss, of which lower is better.

        The value itself, its opposite, or its distance from ``target``.
        """
        return {
            Direction.LOWER: value,
            Direction.HIGHER: -value,
            Direction.TARGET: abs(value - (target or 0.0)),
        }[self]


def _as_numbers(outcome: object, *fields: str) -> None:
    """Make these fields of a frozen ``outcome`` arrays of numbers, read-only."""
    kind = type(outcome).__name__
    numbers = {name: _numbers(f"{name} of {kind}", getattr(outcome, name)) for name in fields}
    lock_fields(outcome, **numbers)


def _numbers(what: str, values: ArrayLike) -> Array:
    """Return ``values`` as floats, or say that they are text, complex or ragged."""
    try:
        array = np.asarray(values)
        if array.dtype == object and any(isinstance(item, str) for item in array.flat):
            raise TypeError("text among them")
        if array.dtype.kind in "biufO":
            return np.asarray(array, dtype=np.float64)
        got = f"an array of {array.dtype}"
    except (TypeError, ValueError) as error:
        got = f"others: {error}"
    raise ValueError(f"expected {what} to be real numbers, in rows of the same length, got {got}")


@dataclass(frozen=True, eq=False)
class Imputation:
    """Truth and prediction of hidden entries; recordings are concatenated along the frames.

    Nested lists are taken as arrays, which are read-only.

    Parameters
    ----------
    truth : ndarray of shape (N, D)
        The observed, noisy values, complete.
    mean : ndarray of shape (N, D)
        Predicted values.
    variance : ndarray of shape (N, D) or None
        Predictive variance of an observation, positive at hidden entries.
    hidden : ndarray of bool, shape (N, D)
        The entries to score.
    visible_mean, visible_variance : ndarray of shape (D,)
        Mean and variance (ddof 0) of each output's visible entries over all recordings that the
        model was given: the trivial Gaussian of the MSLL.
    scales : ndarray of shape (D,) or None
        What errors of joint angles in degrees are multiplied by to be comparable, NaN for outputs
        that are not joint angles; None where a task has no such scales.
    units : tuple of D str
        Unit of each output, such as ``"deg"`` or ``"cm"``; empty strings where outputs are scored
        in units of their own.
    place_joints : callable or None
        Places the joints of truth and prediction in space, where the outputs say how; called at
        most once, and only if a metric asks for `poses`.

    Raises
    ------
    ValueError
        If ``hidden`` is not boolean, other fields are not real numbers, or ``units`` is not a
        sequence of strings; on access to `poses`, if the outcome has no ``place_joints``.
    """

    truth: Array
    mean: Array
    variance: Array | None
    hidden: NDArray[np.bool_]
    visible_mean: Array
    visible_variance: Array
    scales: Array | None = None
    units: tuple[str, ...] = ()
    place_joints: Callable[[], ImputedPoses] | None = None

    def __post_init__(self) -> None:
        optional = (name for name in ("variance", "scales") if getattr(self, name) is not None)
        _as_numbers(self, "truth", "mean", "visible_mean", "visible_variance", *optional)
        mask = np.asarray(self.hidden)
        if mask.dtype != np.bool_:  # numbers would be taken as frames
            raise ValueError(
                f"expected hidden to be True or False for each entry, got numbers of {mask.dtype}"
            )
        lock_fields(self, hidden=mask)
        self._check_units()

    def _check_units(self) -> None:
        # A single string would be taken as one unit per letter.
        units: object = self.units
        listed = isinstance(units, Sequence | np.ndarray) and not isinstance(units, str)
        if not listed or not all(isinstance(unit, str) for unit in self.units):
            raise ValueError(
                f"expected units to be a sequence of one string per output, got {units!r}"
            )

    @cached_property
    def poses(self) -> ImputedPoses:
        """The joints of truth and prediction in space."""
        return _placed(self.place_joints)


@dataclass(frozen=True, eq=False)
class Synthesis:
    """Sampled recordings, and the reference recordings to compare them with.

    Nested lists are taken as arrays, which are read-only.

    Parameters
    ----------
    samples : ndarray of shape (S, N, D)
        Sampled recordings, noise included.
    references : ndarray of shape (M, N, D)
        Reference recordings on the same number of frames.
    place_joints : callable or None
        Places the joints of samples and references in space, where the outputs say how; called at
        most once, and only if a metric asks for `poses`.

    Raises
    ------
    ValueError
        If samples or references are not real numbers; on access to `poses`, if the outcome has no
        ``place_joints``.
    """

    samples: Array
    references: Array
    place_joints: Callable[[], SampledPoses] | None = None

    def __post_init__(self) -> None:
        _as_numbers(self, "samples", "references")

    @cached_property
    def poses(self) -> SampledPoses:
        """The joints of samples and references in space."""
        return _placed(self.place_joints)


PosesT = TypeVar("PosesT", ImputedPoses, SampledPoses)


def _placed(place_joints: Callable[[], PosesT] | None) -> PosesT:
    if place_joints is None:
        raise ValueError(
            "expected an outcome with poses, got one without a skeleton: give place_joints"
        )
    return place_joints()


def has_poses(outcome: Imputation | Synthesis) -> bool:
    """Return whether joints can be placed in space: whether the outcome comes with a skeleton."""
    return outcome.place_joints is not None


@dataclass(frozen=True, eq=False)
class Clustering:
    """Clusters of recordings, and their known classes.

    Lists are taken as arrays, which are read-only.

    Parameters
    ----------
    truth : ndarray of int or str, shape (K,)
        The class of each recording.
    labels : ndarray of int, shape (K,)
        Number of the cluster of each recording; the order of the numbers has no meaning.

    Raises
    ------
    ValueError
        If labels are not whole numbers.
    """

    truth: NDArray[Any]
    labels: NDArray[np.intp]

    def __post_init__(self) -> None:
        labels = np.asarray(self.labels)
        if labels.size and labels.dtype.kind not in "iu":
            raise ValueError(
                f"expected labels to be the whole number of a cluster for each recording, "
                f"got {self.labels!r}"
            )
        lock_fields(self, truth=np.asarray(self.truth), labels=labels)


@dataclass(frozen=True, eq=False)
class Recovery:
    """True and estimated covariances of the layers of a process.

    Nested lists are taken as arrays, which are read-only.

    Parameters
    ----------
    truth : mapping of str to ndarray of shape (n, n)
        Covariance of the curves of each layer, ``"parent"`` and ``"child"``, without noise.
    estimate : mapping of str to ndarray of shape (n, n)
        Estimated covariances, of the layers that the model has.
    noise : float
        Variance of the noise in which the curves were observed.

    Raises
    ------
    ValueError
        If covariances are not a mapping of layers to real numbers, or the noise is not a number.
    """

    truth: Mapping[str, Array]
    estimate: Mapping[str, Array]
    noise: float

    def __post_init__(self) -> None:
        for name in ("truth", "estimate"):
            layers = getattr(self, name)
            if not isinstance(layers, Mapping):
                raise ValueError(
                    f"expected {name} to be a mapping of layers to covariances, got {layers!r}"
                )
            matrices = {
                layer: read_only(_numbers(f"{name} of layer {layer!r}", matrix))
                for layer, matrix in layers.items()
            }
            object.__setattr__(self, name, MappingProxyType(matrices))
        noise: object = self.noise
        if not isinstance(noise, Real):
            raise ValueError(f"expected noise to be a variance, got {noise!r}")

    def __reduce__(self) -> tuple[Any, ...]:
        """Return what pickle makes it from: a mapping that is read-only cannot be pickled."""
        return type(self), (dict(self.truth), dict(self.estimate), self.noise)


@dataclass(frozen=True, eq=False)
class Score:
    """A metric's value, and the values of which it is the mean.

    Parameters
    ----------
    value : float
        The aggregate; NaN where the metric is not defined for this outcome. A job whose score is
        infinite, or NaN since numbers overflowed, has failed.
    parts : mapping of str to ndarray
        The values along ``"output"`` (D,), ``"joint"`` (J,), ``"frame"`` (N,), ``"sample"`` (S,),
        ``"reference"`` (M,), ``"reference_sd"`` (M,) over samples, or ``"bin"``, where the metric
        has them; NaN where an item was left out.
    left_out : int
        How many outputs were left out as degenerate.
    """

    value: float
    parts: Mapping[str, Array] = field(default_factory=dict)
    left_out: int = 0


OutcomeT = TypeVar("OutcomeT", Imputation, Synthesis, Clustering, Recovery)


def _always(outcome: object) -> bool:
    del outcome
    return True


@dataclass(frozen=True)
class Metric(Generic[OutcomeT]):
    """A named, directed, pure function of an outcome.

    Parameters
    ----------
    name : str
        Name in tables and records, for example ``"mse"``.
    title : str
        Heading for people, for example ``"Mean squared error (MSE)"``.
    direction : Direction
        Which values are better.
    outcome : type
        `Imputation`, `Synthesis`, `Clustering` or `Recovery`: the kind of outcome it takes.
    statistic : callable
        From the outcome to a `Score`; its docstring states formula, axis and ddof.
    needs_variance : bool
        Whether it is defined only for a predictive distribution.
    target : float or None
        The ideal value where the direction is ``TARGET``; None otherwise, else a `ValueError`.
    defined : callable
        From an outcome of that kind to whether the metric is defined for it.
    former_names : tuple of str
        Names that the metric had in earlier versions; stored values and options may still use
        them.
    sentence : str
        What it says, for people who do not know it; at most 30 words.
    unit : str
        For example ``"cm"``; empty where it has none.
    range : str
        The values that it can take, for example ``"0 to ∞"``.
    source : str
        The paper that defines it, or ``"this project"``.
    """

    name: str
    title: str
    direction: Direction
    outcome: type[OutcomeT]
    statistic: Callable[[OutcomeT], Score]
    needs_variance: bool = False
    target: float | None = None
    defined: Callable[[OutcomeT], bool] = _always
    former_names: tuple[str, ...] = ()
    sentence: str = ""
    unit: str = ""
    range: str = ""
    source: str = ""

    def __post_init__(self) -> None:
        if (self.direction is Direction.TARGET) != (self.target is not None):
            raise ValueError(
                f"metric {self.name!r}: expected a target where values near one are better, and "
                f"none otherwise, got direction {self.direction.value!r} and target {self.target}; "
                "set the two together"
            )

    def applies(self, outcome: object) -> bool:
        """Return whether the metric is defined for ``outcome``, which may be of any kind."""
        probabilistic = getattr(outcome, "variance", None) is not None
        return (
            isinstance(outcome, self.outcome)
            and (probabilistic or not self.needs_variance)
            and self.defined(outcome)
        )

    def __call__(self, outcome: OutcomeT) -> Score:
        """Return the score of ``outcome``.

        Raises
        ------
        ValueError
            If it is an outcome of another kind, or one that cannot be scored.
        """
        if not isinstance(outcome, self.outcome):
            raise ValueError(
                f"metric {self.name!r}: expected an outcome of class {self.outcome.__name__}, "
                f"got {type(outcome).__name__}; choose a metric that applies to it"
            )
        return self.statistic(outcome)

    def loss(self, value: float) -> float:
        """Return ``value`` as a loss, of which lower is better: see `Direction.loss`."""
        return self.direction.loss(value, self.target)
