"""What the report needs to know about a metric."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.metrics.base import Direction

__all__ = ["MetricInfo"]


@dataclass(frozen=True)
class MetricInfo:
    """The title of a metric, the direction in which it improves, and what it says.

    Parameters
    ----------
    name, title : str
        Name in tables and records; heading for people.
    direction : Direction
        Or its value: ``"lower"``, ``"higher"``, ``"target"``.
    target : float or None
        The ideal value where the direction is ``TARGET``.
    of_distribution : bool
        Whether it scores a predictive distribution, not single predictions or samples.
    sentence, unit, range, source : str
        What it says, its unit, the values it can take and the paper that defines it; each empty
        where it is not stated, and the unit where there is none.

    Raises
    ------
    ValueError
        If the direction is none of the three, or is ``TARGET`` and the target is missing.
    """

    name: str
    title: str
    direction: Direction
    target: float | None = None
    of_distribution: bool = False
    sentence: str = ""
    unit: str = ""
    range: str = ""
    source: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "direction", Direction(self.direction))
        if self.direction is Direction.TARGET and self.target is None:
            raise ValueError(f"metric {self.name!r}: expected a target, got None")

    def loss(self, value: float) -> float:
        """Return the loss of ``value``: lower is better for every direction."""
        return self.direction.loss(value, self.target)

    def linear_losses(self, values: Array) -> Array:
        """Return losses whose mean over the folds of a case is the loss of the mean.

        Where the metric has a target, the loss is the distance from it on the side where the mean
        of the case lies: above it, what a fold has more; below it, what it has less.

        Parameters
        ----------
        values : ndarray of shape (..., n_folds)
            NaN where a fold has no score.
        """
        if self.direction is not Direction.TARGET or self.target is None:
            return np.asarray(self.loss(1.0) * values)
        distances = np.where(np.isfinite(values), values - self.target, 0.0)
        below = distances.sum(axis=-1, keepdims=True) < 0.0
        return np.where(below, -1.0, 1.0) * (values - self.target)

    @property
    def short(self) -> str:
        """The abbreviation that the title ends in, or its part before a bracket."""
        return self._abbreviation or self.title.partition(" (")[0]

    @property
    def quantity(self) -> str:
        """The short name with the unit, but for a unit that is a phrase."""
        wanted = self.unit and " " not in self.unit and self.unit not in self.short
        return f"{self.short}, {self.unit}" if wanted else self.short

    @property
    def acronym(self) -> str:
        """The capitals of the abbreviation, such as SMSE of “pooled SMSE”; empty without one."""
        return self._abbreviation.rpartition(" ")[2]

    @property
    def _abbreviation(self) -> str:
        found = re.search(r"\(((?:\w+ )?[A-Z]{2,})\)", self.title)
        return found[1] if found else ""

    @property
    def better(self) -> str:
        """Which values are better: ``"lower"``, ``"higher"`` or ``"closest to 1"``."""
        return self.direction.value if self.target is None else f"closest to {self.target:g}"
