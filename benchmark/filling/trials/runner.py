"""A model in the race, and its answers."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import count, takewhile

from mocapbench.benchmark.filling.attempt import Attempt
from mocapbench.benchmark.filling.question import FilledEntries

__all__ = ["Runner"]


@dataclass(eq=False)
class Runner:
    """A model in the race.

    Parameters
    ----------
    model : str
    found : dict of int to FilledEntries
        Its answers, by the number of the trial.
    trouble : str
        Why it has no more of them.
    late : bool
        Whether that is because its time, or the budget, was used up.
    windows : int
        Into how many windows it had the longest trial cut; 0 if into none.
    seconds : float
        What its attempts took, those that were stopped too.
    """

    model: str
    found: dict[int, FilledEntries] = field(default_factory=dict)
    trouble: str = ""
    late: bool = False
    windows: int = 0
    seconds: float = 0.0

    @property
    def answers(self) -> list[FilledEntries]:
        """Those to the first trials, in order, up to one that it has not answered."""
        return [self.found[number] for number in takewhile(self.found.__contains__, count())]

    def take(self, number: int, attempt: Attempt) -> None:
        """Take note of what an attempt at a trial took, and of its answer if there is one."""
        self.seconds += attempt.seconds
        self.windows = max(self.windows, attempt.windows)
        if attempt.answer is not None:
            self.found[number] = attempt.answer

    def note(self, attempt: Attempt) -> None:
        """Take note of how the attempt ended that decides whether it goes on."""
        self.trouble, self.late = attempt.trouble, attempt.slow
