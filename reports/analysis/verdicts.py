"""What to make of our numbers beside the published ones.

A verdict asks two questions: does our mean agree with the published value, and do the folds pin
our mean down well enough to say so? Noise in our folds can only move a verdict to *undecided*.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum

from mocapbench.reports.analysis.results import Estimate, TaskResults
from mocapbench.reports.bundle.bundle import CaseLayout, MetricInfo
from mocapbench.reports.paper.published import PublishedValue

__all__ = [
    "Comparison",
    "Tally",
    "Verdict",
    "allowance",
    "comparisons",
    "every_comparison",
    "tally",
    "verdict",
]

RELATIVE_TOLERANCE = 0.02


class Verdict(Enum):
    """How our mean stands to a published value."""

    REPRODUCED = "reproduced"
    BETTER = "better"
    WORSE = "worse"
    UNDECIDED = "undecided"
    NOT_COMPARABLE = "not comparable"


@dataclass(frozen=True)
class Comparison:
    """One published value beside our estimate.

    Parameters
    ----------
    case : CaseLayout
    label : str
    ours : Estimate
    published : PublishedValue
    half_width : float or None
        Half the 95 % interval of our mean; None where the folds give none.
    verdict : Verdict
    reason : str
        Why the two may not be compared, empty where they may.
    """

    case: CaseLayout
    label: str
    ours: Estimate
    published: PublishedValue
    half_width: float | None
    verdict: Verdict
    reason: str

    @property
    def on_one_fold(self) -> bool:
        """Whether a verdict was passed on a single fold."""
        return self.ours.n == 1 and self.verdict is not Verdict.NOT_COMPARABLE


@dataclass(frozen=True)
class Tally:
    """How often each verdict was passed, all of them in fixed order, and how often on one fold."""

    counts: dict[str, int]
    on_one_fold: int


def allowance(published: PublishedValue) -> float:
    """Return how far from ``published`` a mean still agrees: 2 % of it, or its ± if greater."""
    return max(RELATIVE_TOLERANCE * abs(published.value), published.two_sd or 0.0)


def verdict(
    ours: float, published: PublishedValue, info: MetricInfo, half_width: float | None = None
) -> Verdict:
    """Judge our mean by a published value.

    Parameters
    ----------
    ours : float
        Our mean.
    published : PublishedValue
    info : MetricInfo
        Which way is better.
    half_width : float or None
        Half the 95 % interval of our mean; None where there is none, and the bare mean is judged.

    Returns
    -------
    Verdict
        *Reproduced* where both the difference and the half-width are within the `allowance`;
        *better* or *worse* where the published value lies outside our interval widened by the
        allowance; otherwise *undecided*.
    """
    allowed, uncertainty = allowance(published), half_width or 0.0
    distance = abs(ours - published.value)
    if max(distance, uncertainty) <= allowed:
        return Verdict.REPRODUCED
    if distance <= allowed + uncertainty:
        return Verdict.UNDECIDED
    return Verdict.BETTER if info.loss(ours) < info.loss(published.value) else Verdict.WORSE


def comparisons(results: TaskResults, metric: str) -> list[Comparison]:
    """Return every pair of an estimate of ours and its published value, label by label."""
    return list(_comparisons(results, metric))


def every_comparison(results: TaskResults) -> list[Comparison]:
    """Return the comparisons of all metrics that the task shows, metric by metric."""
    return [pair for metric in results.layout.metrics for pair in comparisons(results, metric)]


def _comparisons(results: TaskResults, metric: str) -> Iterator[Comparison]:
    for label in results.layout.labels:
        for case in results.cases:
            published = results.printed(case, label, metric)
            ours = results.estimate(case.name, label, metric)
            if published is not None and ours is not None:
                reason = _reason(results, case, label, metric, published)
                half_width = ours.half_width if results.layout.independent_folds else None
                judged = verdict(ours.mean, published, results.metrics[metric], half_width)
                final = Verdict.NOT_COMPARABLE if reason else judged
                yield Comparison(case, label, ours, published, half_width, final, reason)


def _reason(
    results: TaskResults, case: CaseLayout, label: str, metric: str, published: PublishedValue
) -> str:
    reasons = results.layout.not_comparable
    synthetic = "generated motion" if case.synthetic else ""
    of_task = reasons.get((label, metric)) or reasons.get((label, "*"))
    return of_task or case.not_comparable.get(label) or published.not_comparable or synthetic


def tally(pairs: Sequence[Comparison]) -> Tally:
    """Count the verdicts."""
    counts = Counter(pair.verdict for pair in pairs)
    return Tally(
        {each.value: counts[each] for each in Verdict}, sum(pair.on_one_fold for pair in pairs)
    )
