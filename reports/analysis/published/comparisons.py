"""Our estimates beside the published values, with a verdict on each pair.

Several of our rows and entrants may correspond to one published value: other kernels, or other
readings of what the paper left open. One of them *answers* it, by a rule that no score enters: the
first, in the order of the page's rows and then of its `published_models`, that may be compared and
has a score. The others are shown beside it and counted nowhere.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product

from mocapbench.reports.analysis.fold_mean import FoldMean
from mocapbench.reports.analysis.published.verdicts import PublishedVerdict, verdict
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.paper.published import PublishedValue
from mocapbench.reports.paper.remarks import PublishedAddress

__all__ = ["Comparison", "answers", "comparisons", "every_comparison", "never_comparable"]


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
    of_task = results.layout.page.not_comparable
    of_case = case.notes.not_comparable.get(label)
    synthetic = "generated motion" if case.synthetic else ""
    shared = of_task.get((label, metric)) or of_task.get((label, "*"))
    return shared or of_case or published.not_comparable or synthetic
