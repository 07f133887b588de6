"""What changed between two runs, as plain values.

The harness compares the runs; this package shows what it found. The runs are called A and B.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

from mocapbench.reports.bundle.metric_info import MetricInfo

__all__ = [
    "ChangeVerdict",
    "ChangedFact",
    "ChangedParameter",
    "ComparedTask",
    "Ending",
    "RunChanges",
    "ScoreChange",
    "Unpaired",
]


class ChangeVerdict(Enum):
    """How the score of a cell in B compares with that in A."""

    BETTER = "better"
    WORSE = "worse"
    MAY_BE_CHANCE = "may be chance"
    UNTESTED = "too few to test"
    INCOMPLETE = "incomplete"
    IDENTICAL = "identical"

    @property
    def more_than_chance(self) -> bool:
        """Whether the difference is more than chance."""
        return self in {ChangeVerdict.BETTER, ChangeVerdict.WORSE}


@dataclass(frozen=True)
class ScoreChange:
    """One metric of one cell in both runs.

    Parameters
    ----------
    task, case, label, metric : str
    n : int
        Number of independent units, such as people.
    first, second : float
        Means in A and in B over the folds that both have.
    low, high : float
        95 % interval of how much better B is; NaN where nothing is tested.
    verdict : ChangeVerdict
    """

    task: str
    case: str
    label: str
    metric: str
    n: int
    first: float
    second: float
    low: float
    high: float
    verdict: ChangeVerdict

    @property
    def relative(self) -> float:
        """The size of the difference, as a share of the mean size of both values."""
        scale = (abs(self.first) + abs(self.second)) / 2.0
        return abs(self.second - self.first) / scale if scale else 0.0


@dataclass(frozen=True)
class ComparedTask:
    """A task that both runs have.

    Parameters
    ----------
    name, title : str
    metrics : mapping of str to MetricInfo
        The metrics compared; slopes are drawn of the first.
    """

    name: str
    title: str
    metrics: Mapping[str, MetricInfo]


@dataclass(frozen=True)
class Ending:
    """A job that ended in another way in B than in A.

    Parameters
    ----------
    where : str
        Its address, for people.
    before, after : str
        How it ended.
    message : str
        Why the one without a score has none.
    """

    where: str
    before: str
    after: str
    message: str


@dataclass(frozen=True)
class ChangedParameter:
    """A parameter of an entrant that has another value in B.

    Parameters
    ----------
    label, name, before, after : str
    tasks : tuple of str
        Where it has.
    """

    label: str
    name: str
    before: str
    after: str
    tasks: tuple[str, ...]


@dataclass(frozen=True)
class ChangedFact:
    """A version, a fact of the machine, or a digest of a recording, in A and in B."""

    name: str
    before: str
    after: str


@dataclass(frozen=True)
class Unpaired:
    """Jobs of both runs that do not solve the same problem, why, and how many."""

    reason: str
    jobs: int


@dataclass(frozen=True)
class RunChanges:
    """Everything that changed from run A to run B.

    Parameters
    ----------
    names : tuple of two str
        What to call the runs.
    tasks : sequence of ComparedTask
    scores : sequence of ScoreChange
        Every metric of every cell that both runs have, task by task.
    newly_failing, newly_passing : sequence of Ending
    parameters : sequence of ChangedParameter
    provenance, recordings : sequence of ChangedFact
    unpaired : sequence of Unpaired
        What was not compared.
    only : tuple of two sequences of str
        What only A has, and only B.
    """

    names: tuple[str, str]
    tasks: Sequence[ComparedTask]
    scores: Sequence[ScoreChange]
    newly_failing: Sequence[Ending]
    newly_passing: Sequence[Ending]
    parameters: Sequence[ChangedParameter]
    provenance: Sequence[ChangedFact]
    recordings: Sequence[ChangedFact]
    unpaired: Sequence[Unpaired]
    only: tuple[Sequence[str], Sequence[str]]

    @property
    def counts(self) -> Mapping[ChangeVerdict, int]:
        """How many scores have each verdict, all verdicts in fixed order."""
        counts = Counter(score.verdict for score in self.scores)
        return {verdict: counts[verdict] for verdict in ChangeVerdict}

    @property
    def more_than_chance(self) -> list[ScoreChange]:
        """The scores whose difference is more than chance, the largest first."""
        return self._largest_first(ChangeVerdict.BETTER, ChangeVerdict.WORSE)

    @property
    def undecided(self) -> list[ScoreChange]:
        """The scores that differ, which may be chance or is not tested, the largest first."""
        return self._largest_first(ChangeVerdict.MAY_BE_CHANCE, ChangeVerdict.UNTESTED)

    @property
    def incomplete(self) -> list[ScoreChange]:
        """The scores of which a run lost folds, the largest difference first."""
        return self._largest_first(ChangeVerdict.INCOMPLETE)

    def _largest_first(self, *verdicts: ChangeVerdict) -> list[ScoreChange]:
        found = [score for score in self.scores if score.verdict in verdicts]
        return sorted(found, key=lambda score: score.relative, reverse=True)
