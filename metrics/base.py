"""Metrics: named, directed functions of an outcome, and the scores that they return."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from functools import partial
from typing import Any, Generic, TypeVar, cast

from mocapbench.basics.arrays import Array
from mocapbench.metrics.outcomes.clustering import Clustering
from mocapbench.metrics.outcomes.imputation import Imputation
from mocapbench.metrics.outcomes.recovery import Recovery
from mocapbench.metrics.outcomes.synthesis import Synthesis

__all__ = ["Direction", "Metric", "Score", "has_poses", "metric"]


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


def has_poses(outcome: Imputation | Synthesis) -> bool:
    """Return whether joints can be placed in space: whether the outcome comes with a skeleton."""
    return outcome.place_joints is not None


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


def _is_defined(outcome: object) -> bool:
    del outcome
    return True


@dataclass(frozen=True)
class Metric(Generic[OutcomeT]):
    """A named, directed, pure function of an outcome, which `metric` declares.

    Its fields are the parameters of `metric`, and these two.

    Parameters
    ----------
    outcome : type
        `Imputation`, `Synthesis`, `Clustering` or `Recovery`: the kind of outcome it takes.
    statistic : callable
        The declared function, from the outcome to a `Score`.
    """

    name: str
    outcome: type[OutcomeT]
    statistic: Callable[[OutcomeT], Score]
    title: str
    direction: Direction
    target: float | None
    sentence: str
    unit: str
    range: str
    source: str
    needs_variance: bool
    defined: Callable[[OutcomeT], bool]

    def __post_init__(self) -> None:
        if (self.direction is Direction.TARGET) != (self.target is not None):
            raise ValueError(
                f"metric {self.name!r}: expected a target where values near one are better, and "
                f"none otherwise, got direction {self.direction.value!r} and target {self.target}; "
                "set the two together"
            )
        # For `help`, doctest and pickle, which look for them on a function.
        function = _declared_function(self.statistic)
        for name, value in {
            "__doc__": function.__doc__,
            "__module__": function.__module__,
            "__wrapped__": function,
        }.items():
            object.__setattr__(self, name, value)

    def __reduce__(self) -> str:
        """Return the name under which its module has it: the function itself is behind it."""
        return self.name

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


def metric(
    *,
    title: str,
    direction: Direction,
    target: float | None = None,
    sentence: str = "",
    unit: str = "",
    range: str = "",  # noqa: A002 - the word of the page
    source: str = "",
    needs_variance: bool = False,
    defined: Callable[[Any], bool] = _is_defined,
    name: str = "",
) -> Callable[[Callable[[OutcomeT], Score]], Metric[OutcomeT]]:
    """Declare the function below as a metric; it is what this decorator returns.

    The function takes an outcome, of the kind that its annotation names, and returns a `Score`. Its
    docstring states formula, axis and ddof.

    Parameters
    ----------
    title : str
        Heading for people, for example ``"Mean squared error (MSE)"``.
    direction : Direction
        Which values are better.
    target : float or None
        The ideal value where the direction is ``TARGET``; None otherwise, else a `ValueError`.
    sentence : str
        What it says, for people who do not know it; at most 30 words.
    unit : str
        For example ``"cm"``; empty where it has none.
    range : str
        The values that it can take, for example ``"0 to ∞"``.
    source : str
        The paper that defines it, or ``"this project"``.
    needs_variance : bool
        Whether it is defined only for a predictive distribution.
    defined : callable
        From an outcome of that kind to whether the metric is defined for it.
    name : str
        Name in tables and records; by default that of the function. One formula with an argument
        makes several metrics: bind it with ``functools.partial``, and name each.

    Raises
    ------
    ValueError
        If the first parameter of the function has no annotation, or one that cannot be resolved.

    Examples
    --------
    >>> import numpy as np
    >>> from mocapbench.metrics import Direction, Imputation, Score, metric
    >>> @metric(title="Worst error", direction=Direction.LOWER, unit="that of the data")
    ... def worst_error(outcome: Imputation) -> Score:
    ...     errors = np.abs(outcome.truth - outcome.mean)
    ...     return Score(float(errors[outcome.hidden].max()))
    >>> worst_error.name
    'worst_error'
    """

    def declare(statistic: Callable[[OutcomeT], Score]) -> Metric[OutcomeT]:
        return Metric(
            name=name or statistic.__name__,
            outcome=_outcome_of(statistic),
            statistic=statistic,
            title=title,
            direction=direction,
            target=target,
            sentence=sentence,
            unit=unit,
            range=range,
            source=source,
            needs_variance=needs_variance,
            defined=defined,
        )

    return declare


def _declared_function(statistic: Callable[..., Score]) -> Callable[..., Score]:
    """Return the function whose arguments may be bound by `functools.partial`."""
    return statistic.func if isinstance(statistic, partial) else statistic


def _outcome_of(statistic: Callable[[OutcomeT], Score]) -> type[OutcomeT]:
    """Return the kind of outcome that a function takes, by the annotation of its parameter."""
    function = _declared_function(statistic)
    try:
        parameters = inspect.signature(function, eval_str=True).parameters.values()
    except NameError as error:
        raise _annotation_error(function, f"one that cannot be resolved: {error}") from error
    found = [parameter.annotation for parameter in parameters][:1]
    if found in ([], [inspect.Parameter.empty]):
        raise _annotation_error(function, "none")
    return cast("type[OutcomeT]", found[0])


def _annotation_error(function: Callable[..., Score], got: str) -> ValueError:
    return ValueError(
        f"metric {function.__name__!r}: expected the kind of outcome as the annotation of its "
        f"first parameter, got {got}; write, for example, "
        f"def {function.__name__}(outcome: Imputation) -> Score, and import Imputation"
    )
