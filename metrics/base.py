"""Metrics: named, directed functions of an outcome, and the scores that they return."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from mocapbench.metrics.outcomes.clustering import Clustering
from mocapbench.metrics.outcomes.imputation import Imputation
from mocapbench.metrics.outcomes.recovery import Recovery
from mocapbench.metrics.outcomes.synthesis import Synthesis

__all__ = ["Direction", "Metric", "Score", "has_poses"]

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
