"""Our estimates beside the published values, with a verdict on each pair.

Several of our rows and entrants may correspond to one published value: other kernels, or other
readings of what the paper left open. One of them *answers* it, by a rule that no score enters: the
first, in the order of the page's rows and then of its `published_models`, that may be compared and
has a score. The others are shown beside it and counted nowhere.

A verdict needs two things: whether our mean agrees with the published value, and whether the folds
determine our mean precisely enough. Noise in our folds can only turn a verdict into *undecided*.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import Enum
from itertools import product

from mocapbench.reports.analysis.estimates import FoldMean
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.bundle.metric_info import MetricInfo
from mocapbench.reports.paper.published import PublishedValue, every_value
from mocapbench.reports.paper.remarks import PublishedAddress

__all__ = [
    "RELATIVE_TOLERANCE",
    "Comparison",
    "PublishedVerdict",
    "allowance",
    "answers",
    "comparisons",
    "count_by_source",
    "count_published",
    "every_comparison",
    "never_comparable",
    "verdict",
]

RELATIVE_TOLERANCE = 0.02


class PublishedVerdict(Enum):
    """How our mean compares with a published value, or why there is no comparison."""

    WITHIN_2_PERCENT = "within 2 %"
    WITHIN_PAPER_SD = "within the paper’s ±"
    BETTER = "better"
    WORSE = "worse"
    UNDECIDED = "undecided"
    NOT_COMPARABLE = "not comparable"
    NOT_RUN = "not run"


def allowance(published: PublishedValue) -> float:
    """Return how far from ``published`` a mean still agrees: 2 % of it, or its ± if greater."""
    return max(RELATIVE_TOLERANCE * abs(published.value), published.two_sd or 0.0)


def verdict(
    ours: float, published: PublishedValue, info: MetricInfo, half_width: float | None = None
) -> PublishedVerdict:
    """Compare our mean with a published value.

    Parameters
    ----------
    ours : float
        Our mean.
    published : PublishedValue
    info : MetricInfo
        Its direction says which of two values is better.
    half_width : float or None
        Half the 95 % interval of our mean. Without one the rule uses the mean alone.

    Returns
    -------
    PublishedVerdict
        *Within 2 %* where both the difference and the half-width are; *within the paper's ±*
        where both are, and not within 2 %; *better* or *worse* where the published value lies
        outside our interval widened by the `allowance`, the greater of the two; otherwise
        *undecided*.
    """
    uncertainty, distance = half_width or 0.0, abs(ours - published.value)
    if max(distance, uncertainty) <= RELATIVE_TOLERANCE * abs(published.value):
        return PublishedVerdict.WITHIN_2_PERCENT
    if max(distance, uncertainty) <= (published.two_sd or 0.0):
        return PublishedVerdict.WITHIN_PAPER_SD
    if distance <= allowance(published) + uncertainty:
        return PublishedVerdict.UNDECIDED
    better = info.loss(ours) < info.loss(published.value)
    return PublishedVerdict.BETTER if better else PublishedVerdict.WORSE


@dataclass(frozen=True)
class Comparison:
    """One published value beside our estimate.

    Parameters
    ----------
    case : CaseLayout
    label, metric : str
    ours : FoldMean
    published : PublishedValue
    verdict : PublishedVerdict
    reason : str
        Why the two cannot be compared, empty where they can.
    """

    case: CaseLayout
    label: str
    metric: str
    ours: FoldMean
    published: PublishedValue
    verdict: PublishedVerdict
    reason: str

    @property
    def on_one_fold(self) -> bool:
        """Whether the verdict rests on a single fold."""
        return self.ours.n == 1 and not self.reason


def comparisons(results: TaskResults, metric: str) -> list[Comparison]:
    """Return every pair of an estimate of ours and its published value, label by label."""
    return list(_comparisons(results, metric))


def every_comparison(results: TaskResults) -> list[Comparison]:
    """Return the comparisons of all metrics that the task shows, metric by metric."""
    return [pair for metric in results.layout.page.metrics for pair in comparisons(results, metric)]


def answers(results: TaskResults) -> Mapping[PublishedAddress, Comparison]:
    """Return, for each published value that may be compared and is, the comparison that counts."""
    cases = [case.name for case in results.cases]
    models = list(results.layout.page.published_models)
    may = [pair for pair in every_comparison(results) if not pair.reason]
    may.sort(key=lambda pair: (cases.index(pair.case.name), models.index(pair.label)))
    first: dict[PublishedAddress, Comparison] = {}
    for pair in may:
        first.setdefault(pair.published.address, pair)
    return first


def never_comparable(results: TaskResults) -> set[PublishedAddress]:
    """Return the published values that rows and entrants stand for, with a reason against each."""
    page = results.layout.page
    readings = [
        (published.address, _reason(results, case, label, metric, published))
        for case, label, metric in product(
            results.layout.cases, page.published_models, page.published_metrics
        )
        if (published := results.published_value(case, label, metric)) is not None
    ]
    return {address for address, _ in readings} - {a for a, reason in readings if not reason}


def _comparisons(results: TaskResults, metric: str) -> Iterator[Comparison]:
    page = results.layout.page
    answering = [label for label in results.layout.labels if label in page.published_models]
    for label in answering:
        for case in results.cases:
            published = results.published_value(case, label, metric)
            ours = results.estimate(case.name, label, metric)
            if published is not None and ours is not None:
                reason = _reason(results, case, label, metric, published)
                by_rule = verdict(ours.mean, published, results.metrics[metric], ours.half_width)
                final = PublishedVerdict.NOT_COMPARABLE if reason else by_rule
                yield Comparison(case, label, metric, ours, published, final, reason)


def _reason(
    results: TaskResults, case: CaseLayout, label: str, metric: str, published: PublishedValue
) -> str:
    """Return why the two cannot be compared: a reason of the task, the case or the paper."""
    page = results.layout.page
    of_case = page.not_comparable_rows.get((case.name, label))
    synthetic = "generated motion" if case.synthetic else ""
    shared = page.not_comparable.get((label, metric)) or page.not_comparable.get((label, "*"))
    return shared or of_case or published.not_comparable or synthetic


def count_published(tasks: Iterable[TaskResults]) -> Mapping[str, int]:
    """Count by verdict every value that the package has of the papers, of other tasks too.

    Returns
    -------
    mapping of str to int
        All verdicts in fixed order; the counts add up to the number of values.
    """
    return _count_verdicts(every_value(), _collect_verdicts(tasks))


def count_by_source(results: TaskResults) -> Mapping[str, Mapping[str, int]]:
    """Count the published values of one task, by the paper's table that they stand in."""
    by_source: dict[str, list[PublishedValue]] = {}
    for value in results.published.values():
        by_source.setdefault(value.source, []).append(value)
    decided = _collect_verdicts([results])
    return {source: _count_verdicts(values, decided) for source, values in by_source.items()}


def _collect_verdicts(tasks: Iterable[TaskResults]) -> Mapping[PublishedAddress, PublishedVerdict]:
    """Return the verdict that counts on each published value that the tasks decide."""
    verdicts: dict[PublishedAddress, PublishedVerdict] = {}
    for results in tasks:
        verdicts |= {address: pair.verdict for address, pair in answers(results).items()}
        verdicts |= dict.fromkeys(never_comparable(results), PublishedVerdict.NOT_COMPARABLE)
    return verdicts


def _count_verdicts(
    values: Iterable[PublishedValue], decided: Mapping[PublishedAddress, PublishedVerdict]
) -> Mapping[str, int]:
    counts = Counter(
        PublishedVerdict.NOT_COMPARABLE
        if value.not_comparable
        else decided.get(value.address, PublishedVerdict.NOT_RUN)
        for value in values
    )
    return {verdict.value: counts[verdict] for verdict in PublishedVerdict}
