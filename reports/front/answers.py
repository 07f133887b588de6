"""A sentence for each question: which model, by what margin, and how sure."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from typing import Any

from mocapbench.basics.words import format_count, join_names
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import (
    MOST_LEVEL,
    Place,
    Standing,
    level_with_best,
    next_best,
    standings,
)
from mocapbench.reports.bundle.task_page import QUESTIONS
from mocapbench.reports.front.scoreboard import (
    board_cells,
    first_metric,
    is_generated,
    reference_of,
)
from mocapbench.reports.text import apart, number, slug

__all__ = ["TESTED", "answers"]

TESTED = (Place.BEHIND, Place.INSEPARABLE)
OF_TOYS = "recover"
"""A question that only generated data can answer, and no user asks."""
NO_RIVAL = "no rival"

Ranked = tuple[TaskResults, Sequence[Standing]]
"""A task with its standings by its first metric, best first, one or more."""


def answers(tasks: Sequence[TaskResults]) -> list[dict[str, Any]]:
    """Return an answer for each question that a task with a ranked score puts.

    Returns
    -------
    list of dict
        ``question``, the title of it; ``model``, which alone is best in more than half of its
        tasks, and there better than the reference, empty where none is; ``doubt``, what the tests
        say of its leads, empty where more than half of its tasks show a lead that is more than
        chance; ``findings``, the anchor, the title and a sentence of each task, those that the
        model leads first; ``sure``, what the tests say of the leads.
    """
    standing = [(task, standings(task, first_metric(task))) for task in tasks]
    ranked = [(task, found) for task, found in standing if found]
    return [
        _answer(title, group)
        for name, (title, _) in QUESTIONS.items()
        if name != OF_TOYS
        and (group := [one for one in ranked if one[0].layout.page.question == name])
    ]


def _answer(question: str, group: Sequence[Ranked]) -> dict[str, Any]:
    leaders = Counter(
        found[0].label
        for task, found in group
        if not level_with_best(found) and not _is_beaten(task, found)
    )
    model, most = leaders.most_common(1)[0] if leaders else ("", 0)
    named = model if 2 * most > len(group) else ""
    first = sorted(group, key=lambda one: one[1][0].label != named)
    alone = [found for _, found in first if not level_with_best(found)]
    return {
        "question": question,
        "model": named,
        "doubt": _doubt(named, alone, len(group)) if named else "",
        "findings": [_describe_task(*one) for one in first],
        "sure": _sure([_lead(found) for found in alone]),
    }


def _doubt(model: str, alone: Sequence[Sequence[Standing]], n_tasks: int) -> str:
    """Return why it is not shown that ``model`` is best in more than half of the tasks."""
    leads = [_lead(found) for found in alone if found[0].label == model]
    if 2 * leads.count(Place.BEHIND) > n_tasks:
        return ""
    doubts = [place.value for place in (Place.INSEPARABLE, Place.UNTESTED) if place in leads]
    return next(iter(doubts), NO_RIVAL)


def _sure(leads: Sequence[Place | None]) -> str:
    """Return how many leads are more than chance, how many may be chance, how many not tested."""
    counts = [(leads.count(place), place) for place in (*TESTED, Place.UNTESTED)]
    parts = "; ".join(f"{count} {place.value}" for count, place in counts if count)
    alone = NO_RIVAL if leads else "no lead"
    return f"{format_count(len(leads), 'lead')}: {parts}" if parts else alone


def _lead(found: Sequence[Standing]) -> Place | None:
    """Return what the test says of the lead; None without a rival."""
    second = next_best(found)
    return second.standing if second else None


def _is_beaten(results: TaskResults, found: Sequence[Standing]) -> bool:
    """Return whether the best model is no better than the task's reference."""
    return board_cells(results)[found[0].label].beaten


def _describe_task(results: TaskResults, found: Sequence[Standing]) -> tuple[str, str, str]:
    """Return the anchor of a task's section, its short title, and what it says."""
    title = results.layout.page.short + (" (synthetic)" if is_generated(results) else "")
    beaten = f"; no better than {reference_of(results)}" if _is_beaten(results, found) else ""
    return slug("task", results.layout.name), title, _describe_means(results, found) + beaten


def _describe_means(results: TaskResults, found: Sequence[Standing]) -> str:
    """Return the best model, its mean, the next, and the margin."""
    best, second, level = found[0], next_best(found), level_with_best(found)
    names = join_names([one.label for one in [best, *level]], MOST_LEVEL)
    alike = ", alike:" if level else ""
    places = results.decimals[first_metric(results)]
    if second is None:
        return f"{names}{alike} {number(best.mean, places)}"
    places = apart(best.mean, second.mean, places)
    mean, following = number(best.mean, places), number(second.mean, places)
    return f"{names}{alike} {mean}, next {second.label} {following}{_margin(second, places)}"


def _margin(second: Standing, places: int) -> str:
    if math.isnan(second.low):
        return ""
    return f" (behind by {number(second.low, places)} to {number(second.high, places)})"
