"""How long a job takes, as far as jobs that are like it tell."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Sequence

__all__ = ["Durations"]


class Durations:
    """The mean seconds of jobs, by kinds to which they belong."""

    def __init__(self) -> None:
        self._count: dict[Hashable, int] = defaultdict(int)
        self._total: dict[Hashable, float] = defaultdict(float)

    def learn(self, kinds: Sequence[Hashable], seconds: float) -> None:
        """Take note that a job of these kinds took so long."""
        for kind in kinds:
            self._count[kind] += 1
            self._total[kind] += seconds

    def knows(self, kinds: Sequence[Hashable]) -> bool:
        """Return whether a job of one of ``kinds`` is known."""
        return any(kind in self._count for kind in kinds)

    def expect_seconds(self, kinds: Sequence[Hashable]) -> float:
        """Return the mean of the first of ``kinds`` of which a job is known; 0 if of none."""
        known = (kind for kind in kinds if kind in self._count)
        return next((self._total[kind] / self._count[kind] for kind in known), 0.0)
