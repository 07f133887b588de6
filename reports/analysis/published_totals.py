"""How many published values stand how, each counted once."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

from mocapbench.reports.analysis.comparisons import answers, never_comparable
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.verdicts import PublishedVerdict
from mocapbench.reports.paper.published import PublishedValue, every_value

__all__ = ["Tally", "published_totals", "tally"]


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
    return _tally(every_value(), list(tasks))


def tally(results: TaskResults, source: str | None = None) -> Tally:
    """Count the published values of one task, or of one ``source`` (a paper's table) in it."""
    values = results.published.values()
    return _tally([v for v in values if source in (None, v.source)], [results])


def _tally(values: Iterable[PublishedValue], tasks: Sequence[TaskResults]) -> Tally:
    answered = dict(chain.from_iterable(answers(results).items() for results in tasks))
    never = set(chain.from_iterable(map(never_comparable, tasks)))
    pairs = [(value, answered.get(value.address)) for value in values]
    counts = Counter(
        PublishedVerdict.NOT_COMPARABLE
        if value.not_comparable or value.address in never
        else pair.verdict
        if pair
        else PublishedVerdict.NOT_RUN
        for value, pair in pairs
    )
    return Tally(
        {verdict.value: counts[verdict] for verdict in PublishedVerdict},
        sum(pair is not None and pair.on_one_fold for _, pair in pairs),
    )
