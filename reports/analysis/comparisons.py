"""Our estimates beside the published values, with a verdict on each pair."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from mocapbench.reports.analysis.fold_mean import FoldMean
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.verdicts import PublishedVerdict, verdict
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.paper.published import PublishedValue

__all__ = ["Comparison", "Tally", "comparisons", "every_comparison", "tally"]


@dataclass(frozen=True)
class Comparison:
    """One published value beside our estimate.

    Parameters
    ----------
    case : CaseLayout
    label : str
    ours : FoldMean
    published : PublishedValue
    half_width : float or None
        Half the 95 % interval of our mean; None where the folds give none.
    verdict : PublishedVerdict
    reason : str
        Why the two cannot be compared, empty where they can.
    """

    case: CaseLayout
    label: str
    ours: FoldMean
    published: PublishedValue
    half_width: float | None
    verdict: PublishedVerdict
    reason: str

    @property
    def on_one_fold(self) -> bool:
        """Whether the verdict rests on a single fold."""
        return self.ours.n == 1 and self.verdict is not PublishedVerdict.NOT_COMPARABLE


@dataclass(frozen=True)
class Tally:
    """A count of verdicts.

    Parameters
    ----------
    counts : mapping of str to int
        By verdict, all of them in fixed order.
    on_one_fold : int
        How many verdicts rest on a single fold.
    """

    counts: Mapping[str, int]
    on_one_fold: int


def comparisons(results: TaskResults, metric: str) -> list[Comparison]:
    """Return every pair of an estimate of ours and its published value, label by label."""
    return list(_comparisons(results, metric))


def every_comparison(results: TaskResults) -> list[Comparison]:
    """Return the comparisons of all metrics that the task shows, metric by metric."""
    return [pair for metric in results.layout.page.metrics for pair in comparisons(results, metric)]


def _comparisons(results: TaskResults, metric: str) -> Iterator[Comparison]:
    for label in results.layout.labels:
        for case in results.cases:
            published = results.published_value(case, label, metric)
            ours = results.estimate(case.name, label, metric)
            if published is not None and ours is not None:
                reason = _reason(results, case, label, metric, published)
                half_width = ours.half_width if results.layout.independent_folds else None
                by_rule = verdict(ours.mean, published, results.metrics[metric], half_width)
                final = PublishedVerdict.NOT_COMPARABLE if reason else by_rule
                yield Comparison(case, label, ours, published, half_width, final, reason)


def _reason(
    results: TaskResults, case: CaseLayout, label: str, metric: str, published: PublishedValue
) -> str:
    """Return why the two cannot be compared: a reason of the task, the case or the paper."""
    of_task = results.layout.page.not_comparable
    of_case = case.notes.not_comparable.get(label)
    synthetic = "generated motion" if case.synthetic else ""
    shared = of_task.get((label, metric)) or of_task.get((label, "*"))
    return shared or of_case or published.not_comparable or synthetic


def tally(pairs: Sequence[Comparison]) -> Tally:
    """Count the verdicts of ``pairs``."""
    counts = Counter(pair.verdict for pair in pairs)
    return Tally(
        {verdict.value: counts[verdict] for verdict in PublishedVerdict},
        sum(pair.on_one_fold for pair in pairs),
    )
