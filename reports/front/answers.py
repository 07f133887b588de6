"""A sentence for each question: which model, by what margin, and how sure."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import (
    MOST_LEVEL,
    Place,
    Standing,
    level_with_best,
    standings,
)
from mocapbench.reports.bundle.questions import QUESTIONS, Question
from mocapbench.reports.front.board_cells import (
    board_cells,
    first_metric,
    is_generated,
    reference_of,
)
from mocapbench.reports.text import counted, listed, number, slug

__all__ = ["TESTED", "Answer", "Finding", "answers"]

TESTED = (Place.BEHIND, Place.INSEPARABLE)
OF_TOYS = "recover"
"""A question that only generated data can answer, and no user asks."""
Ranked = Sequence[Standing]
"""Standings, best first."""


@dataclass(frozen=True)
class Finding:
    """What one task says.

    Parameters
    ----------
    id, title : str
        The anchor of the task's section, and its short title.
    text : str
        The best model, its mean, the next, and the margin.
    """

    id: str
    title: str
    text: str


@dataclass(frozen=True)
class Answer:
    """What the run says to one question.

    Parameters
    ----------
    question, ask : str
        Its title, and the question in one sentence.
    model : str
        The model that alone is best in more than half of its tasks, and there better than the
        reference; empty where none is.
    findings : tuple of Finding
        One for each task, those that ``model`` leads first.
    sure : str
        What the tests say of the leads.
    """

    question: str
    ask: str
    model: str
    findings: tuple[Finding, ...]
    sure: str


def answers(tasks: Sequence[TaskResults]) -> list[Answer]:
    """Return an answer for each question that a task with a ranked score puts."""
    ranked = [(task, standings(task, first_metric(task))) for task in tasks]
    return [
        _answer(each, group)
        for each in QUESTIONS
        if each.name != OF_TOYS
        and (group := [(t, s) for t, s in ranked if s and t.layout.page.question == each.name])
    ]


def _answer(question: Question, group: Sequence[tuple[TaskResults, Ranked]]) -> Answer:
    leaders = Counter(
        ranked[0].label
        for task, ranked in group
        if not level_with_best(ranked) and not _beaten(task, ranked[0])
    )
    model, most = leaders.most_common(1)[0] if leaders else ("", 0)
    named = model if 2 * most > len(group) else ""
    first = sorted(group, key=lambda pair: pair[1][0].label != named)
    return Answer(
        question.title,
        question.ask,
        named,
        tuple(_finding(task, ranked) for task, ranked in first),
        _sure([_lead(ranked) for _, ranked in first if not level_with_best(ranked)]),
    )


def _finding(results: TaskResults, ranked: Ranked) -> Finding:
    best, second = ranked[0], _next(ranked)
    level = level_with_best(ranked)
    alike = ", alike:" if level else ""
    names = listed([one.label for one in [best, *level]], MOST_LEVEL)
    text = f"{names}{alike} {_mean(results, best)}"
    if second is not None:
        text += f", next {second.label} {_mean(results, second)}{_margin(results, second)}"
    text += f"; no better than {reference_of(results)}" if _beaten(results, best) else ""
    title = results.layout.page.short + (" (synthetic)" if is_generated(results) else "")
    return Finding(slug("task", results.layout.name), title, text)


def _next(ranked: Ranked) -> Standing | None:
    """Return the best of those that have every score and another mean than the first."""
    level = level_with_best(ranked)
    return next((one for one in ranked[1:] if one.complete and one not in level), None)


def _mean(results: TaskResults, standing: Standing) -> str:
    return number(standing.mean, results.decimals[first_metric(results)])


def _margin(results: TaskResults, second: Standing) -> str:
    if math.isnan(second.low):
        return ""
    places = results.decimals[first_metric(results)]
    low, high = number(second.low, places), number(second.high, places)
    return f" (behind by {low} to {high})"


def _lead(ranked: Ranked) -> Place | None:
    """Return what the test says of the lead; None without a rival."""
    second = _next(ranked)
    return second.standing if second else None


def _sure(leads: Sequence[Place | None]) -> str:
    """Return how many leads are more than chance, how many may be chance, how many not tested."""
    counts = [(leads.count(place), place) for place in (*TESTED, Place.UNTESTED)]
    told = "; ".join(f"{count} {place.value}" for count, place in counts if count)
    alone = "no rival" if leads else "no lead"
    return f"{counted(len(leads), 'lead')}: {told}" if told else alone


def _beaten(results: TaskResults, best: Standing) -> bool:
    """Return whether the best model is no better than the task's reference."""
    return board_cells(results)[best.label].beaten
