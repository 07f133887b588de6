"""What changed between two runs, as plain values.

The harness compares the runs; this package shows what it found. The runs are called A and B.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum

from mocapbench.reports.bundle.metric_info import MetricInfo

__all__ = ["Change", "ChangeVerdict", "RunChanges", "ScoreChange"]


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
class Change:
    """What has another value in B than in A: a job's ending, a parameter, a version, a digest.

    Parameters
    ----------
    name : str
        What it is, for people.
    before, after : str
        In A and in B.
    message : str
        Of a job: why the one without a score has none.
    """

    name: str
    before: str
    after: str
    message: str = ""


@dataclass(frozen=True)
class RunChanges:
    """Everything that changed from run A to run B.

    Parameters
    ----------
    names : tuple of two str
        What to call the runs.
    titles : mapping of str to str
        Of the tasks that both runs have, by name.
    metrics : mapping of str to mapping of str to MetricInfo
        By task, the metrics compared; slopes are drawn of the first.
    scores : sequence of ScoreChange
        Every metric of every cell that both runs have, task by task.
    newly_failing, newly_passing : sequence of Change
        Jobs that ended in another way.
    parameters : mapping of (label, Change) to sequence of str
        Parameters of entrants, with the tasks where they have changed.
    provenance, recordings : sequence of Change
        Versions and facts of machines, and digests of recordings.
    unpaired : mapping of str to int
        Why jobs of both runs do not solve the same problem, and how many do not.
    only : tuple of two sequences of str
        What only A has, and only B.
    """

    names: tuple[str, str]
    titles: Mapping[str, str]
    metrics: Mapping[str, Mapping[str, MetricInfo]]
    scores: Sequence[ScoreChange]
    newly_failing: Sequence[Change]
    newly_passing: Sequence[Change]
    parameters: Mapping[tuple[str, Change], Sequence[str]]
    provenance: Sequence[Change]
    recordings: Sequence[Change]
    unpaired: Mapping[str, int]
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
