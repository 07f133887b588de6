"""Headlines on the best mean of each case."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from mocapbench.reports.analysis.best_over_cases import best_over_cases
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.wins import mean_over_cases
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.page.headline import Headline, cases_phrase, same_places
from mocapbench.reports.tables.rank_notes import lead_note

__all__ = ["lead_headlines"]


def lead_headlines(results: TaskResults, metric: str) -> list[Headline]:
    """Name the entrants with the best mean, in which cases and by how much, most cases first.

    The best interpolation over the same cases stands beside each, where one takes part.
    """
    cases = results.representative_cases(metric)
    leaders = Counter(results.ranking(case.name, metric)[0] for case in cases)
    return [
        Headline(label, _lead(results, metric, label, cases)) for label, _ in leaders.most_common()
    ]


def _lead(results: TaskResults, metric: str, label: str, cases: Sequence[CaseLayout]) -> str:
    led = [case for case in cases if results.ranking(case.name, metric)[0] == label]
    title, where = results.metrics[metric].title, cases_phrase(led, len(cases))
    if not any(results.ranking(case.name, metric)[1:] for case in led):
        return f"is the only entrant with a score in {where} ({title})."
    lead = f"is best in {where} by {title}: {_margin(results, metric, label, led)}."
    beside = _beside(results, metric, label, led)
    note = lead_note(results, metric, label, [case.name for case in led])
    return " ".join(filter(None, (lead, note, beside)))


def _margin(results: TaskResults, metric: str, label: str, led: Sequence[CaseLayout]) -> str:
    """Return the mean over the cases that ``label`` leads, and that of the next best model."""
    first = mean_over_cases(results, metric, led, [label] * len(led))
    others = [other for other in results.layout.ranked if other != label]
    following = best_over_cases(results, metric, led, others, beside=label)
    if following is None:
        (mean,) = same_places(first)
        return f"{mean} on average, and no other entrant has every score there"
    second = mean_over_cases(results, metric, led, [following] * len(led))
    mean, next_best = same_places(first, second)
    return f"{mean} on average, next best {following} with {next_best}"


def _beside(results: TaskResults, metric: str, label: str, led: Sequence[CaseLayout]) -> str:
    """Return a sentence that names the best interpolation, empty where none takes part."""
    best = best_over_cases(results, metric, led, results.layout.interpolations, beside=label)
    if best is None:
        return ""
    if best == label:
        return "The best model is itself an interpolation."
    (mean,) = same_places(mean_over_cases(results, metric, led, [best] * len(led)))
    return f"Best interpolation: {best}, {mean}."
