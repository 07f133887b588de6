"""The headline on a task's best entrant, and the words for a tested difference."""

from __future__ import annotations

from mocapbench.basics.words import join_names
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import (
    MOST_LEVEL,
    Place,
    Standing,
    level_with_best,
    standings,
)
from mocapbench.reports.page.headline import Headline, cases_phrase, same_places

__all__ = ["lead_headlines"]


def lead_headlines(results: TaskResults, metric: str) -> list[Headline]:
    """Name the entrant with the best mean over all representative cases, and the next best.

    Returns
    -------
    list of Headline
        Empty where no entrant has a score.
    """
    found = standings(results, metric)
    return [Headline(found[0].label, _lead(results, metric, *found))] if found else []


def _lead(results: TaskResults, metric: str, best: Standing, *others: Standing) -> str:
    title = results.metrics[metric].short
    where = cases_phrase(results.representative_cases(metric))
    if not others:
        return f"is the only entrant with a score in {where} ({title})."
    following = next((other for other in others if other.complete), None)
    if following is None:
        (mean,) = same_places(best.mean)
        return f"is best over {where} by {title}, {mean}; no other entrant has every score."
    if level := level_with_best([best, *others]):
        (mean,) = same_places(best.mean)
        names = join_names([one.label for one in level], MOST_LEVEL)
        return f"is level with {names} over {where} by {title}, {mean}."
    sentence = f"is best over {where} by {title}: {_margin(best, following)}."
    return " ".join(filter(None, (sentence, _interpolation(results, best, *others))))


def _margin(best: Standing, following: Standing) -> str:
    """Return both means and their difference, with what the test says of it."""
    if following.standing is Place.UNTESTED:
        mean, next_best = same_places(best.mean, following.mean)
        return f"{mean}, next best {following.label} {next_best}; {following.finding}"
    mean, next_best, difference, low, high = same_places(
        best.mean, following.mean, following.difference, following.low, following.high
    )
    interval = f"difference {difference} ({low} to {high})"
    return f"{mean}, next best {following.label} {next_best}; {interval}, {following.finding}"


def _interpolation(results: TaskResults, *found: Standing) -> str:
    """Return which interpolation is best, unless the sentence before names it."""
    complete = [standing for standing in found if standing.complete]
    labels = results.layout.interpolations
    place = next((at for at, standing in enumerate(complete) if standing.label in labels), 0)
    if place < 2:
        return ""
    (mean,) = same_places(complete[place].mean)
    return f"Best interpolation: {complete[place].label}, {mean}."
