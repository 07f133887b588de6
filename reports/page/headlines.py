"""The headlines of a task: its best entrant, and models better than those of the paper.

A headline is its subject, which the page emphasises, and the rest of the sentence. A model that the
paper lacks and that is better is often a simple baseline. For each of the paper's models only the
best of them is named, with what a paired test says of the lead.
"""

from __future__ import annotations

from collections.abc import Sequence

from mocapbench.basics.words import join_names
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import (
    MOST_LEVEL,
    Place,
    Standing,
    level_with_best,
    standings,
)
from mocapbench.reports.analysis.wins import wins
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.text import apart, decimals, number

__all__ = ["Headline", "lead_headlines", "win_headlines"]

Headline = tuple[str, str]
"""The subject of a sentence, and the rest of it."""


def lead_headlines(results: TaskResults, metric: str) -> list[Headline]:
    """Name the entrant with the best mean over all representative cases, and the next best.

    Returns
    -------
    list of Headline
        Empty where no entrant has a score.
    """
    found = standings(results, metric)
    return [(found[0].label, _describe_lead(results, metric, *found))] if found else []


def win_headlines(results: TaskResults, metric: str) -> list[Headline]:
    """Name each model that the paper lacks with the paper's models that it is better than."""
    of_winners: dict[str, dict[str, list[str]]] = {}
    for loser, (winner, finding) in wins(results, metric).items():
        of_winners.setdefault(winner, {}).setdefault(finding, []).append(loser)
    return [
        (winner, f"has a better mean than {_describe_losers(of_winners[winner])}.")
        for winner in results.layout.labels
        if winner in of_winners
    ]


def _describe_losers(by_finding: dict[str, list[str]]) -> str:
    return "; ".join(f"{', '.join(names)}, {finding}" for finding, names in by_finding.items())


def _describe_lead(results: TaskResults, metric: str, best: Standing, *others: Standing) -> str:
    title = results.metrics[metric].short
    where = _count_cases(results.representative_cases(metric))
    if not others:
        return f"is the only entrant with a score in {where} ({title})."
    following = next((other for other in others if other.complete), None)
    (mean,) = _format_alike(best.mean)
    if following is None:
        return f"is best over {where} by {title}, {mean}; no other entrant has every score."
    if level := level_with_best([best, *others]):
        names = join_names([one.label for one in level], MOST_LEVEL)
        return f"is level with {names} over {where} by {title}, {mean}."
    sentence = f"is best over {where} by {title}: {_describe_margin(best, following)}."
    return " ".join(filter(None, (sentence, _name_interpolation(results, best, *others))))


def _describe_margin(best: Standing, following: Standing) -> str:
    """Return both means and their difference, with what the test says of it."""
    if following.standing is Place.UNTESTED:
        mean, next_best = _format_alike(best.mean, following.mean)
        return f"{mean}, next best {following.label} {next_best}; {following.finding}"
    mean, next_best, difference, low, high = _format_alike(
        best.mean, following.mean, following.difference, following.low, following.high
    )
    interval = f"difference {difference} ({low} to {high})"
    return f"{mean}, next best {following.label} {next_best}; {interval}, {following.finding}"


def _name_interpolation(results: TaskResults, *found: Standing) -> str:
    """Return which interpolation is best, unless the sentence before names it."""
    complete = [standing for standing in found if standing.complete]
    labels = results.layout.interpolations
    place = next((at for at, standing in enumerate(complete) if standing.label in labels), 0)
    if place < 2:
        return ""
    (mean,) = _format_alike(complete[place].mean)
    return f"Best interpolation: {complete[place].label}, {mean}."


def _count_cases(cases: Sequence[CaseLayout]) -> str:
    """Return how many cases there are, and how many of them are generated."""
    synthetic = sum(case.synthetic for case in cases)
    whole = {1: "the only case", 2: "both cases"}.get(len(cases), f"all {len(cases)} cases")
    return whole + (f" ({synthetic} synthetic)" if synthetic else "")


def _format_alike(value: float, *others: float) -> list[str]:
    """Return values with one number of decimals for all, which tells the first two apart."""
    values = (value, *others)
    places = apart(value, others[0], decimals(values)) if others else decimals(values)
    return [number(each, places) for each in values]
