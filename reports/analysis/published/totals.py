"""How many published values stand how, each counted once."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from mocapbench.reports.analysis.published.comparisons import answers, never_comparable
from mocapbench.reports.analysis.published.verdicts import PublishedVerdict
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.paper.published import PublishedValue, every_value
from mocapbench.reports.paper.remarks import PublishedAddress

__all__ = ["Tally", "published_totals", "tallies_by_source"]


@dataclass(frozen=True)
class Tally:
    """A count of published values.

    Parameters
    ----------
    counts : mapping of str to int
        By verdict, all of them in fixed order; they add up to the number of values.
    on_one_fold : int
        How many verdicts rest on a single fold.
    """

    counts: Mapping[str, int]
    on_one_fold: int

    @property
    def total(self) -> int:
        """The number of values."""
        return sum(self.counts.values())

    @property
    def compared(self) -> int:
        """The number of values that were compared with a score."""
        apart = (PublishedVerdict.NOT_COMPARABLE, PublishedVerdict.NOT_RUN)
        return self.total - sum(self.counts[verdict.value] for verdict in apart)


def published_totals(tasks: Iterable[TaskResults]) -> Tally:
    """Count every value that the package has of the papers, those of other tasks included."""
    return _sum(every_value(), _collect_verdicts(tasks))


def tallies_by_source(results: TaskResults) -> Mapping[str, Tally]:
    """Count the published values of one task, by the paper's table that they stand in."""
    by_source: dict[str, list[PublishedValue]] = {}
    for value in results.published.values():
        by_source.setdefault(value.source, []).append(value)
    counted = _collect_verdicts([results])
    return {source: _sum(values, counted) for source, values in by_source.items()}


Counted = Mapping[PublishedAddress, tuple[PublishedVerdict, bool]]
"""By published value, the verdict that counts, and whether it rests on one fold."""


def _collect_verdicts(tasks: Iterable[TaskResults]) -> Counted:
    """Return the verdicts that the tasks decide."""
    verdicts: dict[PublishedAddress, tuple[PublishedVerdict, bool]] = {}
    for results in tasks:
        answered = answers(results).items()
        verdicts |= {address: (pair.verdict, pair.on_one_fold) for address, pair in answered}
        verdicts |= dict.fromkeys(
            never_comparable(results), (PublishedVerdict.NOT_COMPARABLE, False)
        )
    return verdicts


def _sum(values: Iterable[PublishedValue], counted: Counted) -> Tally:
    decided = [
        (PublishedVerdict.NOT_COMPARABLE, False)
        if value.not_comparable
        else counted.get(value.address, (PublishedVerdict.NOT_RUN, False))
        for value in values
    ]
    counts = Counter(verdict for verdict, _ in decided)
    return Tally(
        {verdict.value: counts[verdict] for verdict in PublishedVerdict},
        sum(on_one_fold for _, on_one_fold in decided),
    )
