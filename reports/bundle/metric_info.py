"""What the report needs to know about a metric."""

from __future__ import annotations

import re
from dataclasses import dataclass

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

    @property
    def short(self) -> str:
        """The abbreviation that the title ends in, or its part before a bracket."""
        return self._abbreviation or self.title.partition(" (")[0]

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
