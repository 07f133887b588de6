"""A sentence for each question: which model, by what margin, and how sure."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import Standing, standings
from mocapbench.reports.bundle.questions import QUESTIONS, Question
from mocapbench.reports.front.board_cells import board_cells, first_metric, reference_of
from mocapbench.reports.text import number, slug

__all__ = ["Answer", "Finding", "answers"]

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
        The best model, its mean, the next, the margin, and what the test says of it where that is
        not the same for all tasks of the question.
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
        The model that is best in most of its tasks; empty where several are in as many.
    findings : tuple of Finding
        One for each task, those that ``model`` leads first.
    sure : str
        What the tests say of all leads; empty where they say different things.
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
    leaders = Counter(ranked[0].label for _, ranked in group)
    (model, most), *others = leaders.most_common()
    alone = all(count < most for _, count in others)
    first = sorted(group, key=lambda pair: alone and pair[1][0].label != model)
    sure = {_sure(ranked) for _, ranked in first}
    return Answer(
        question.title,
        question.ask,
        model if alone else "",
        tuple(_finding(task, ranked, told=len(sure) == 1) for task, ranked in first),
        f"The lead: {sure.pop()}." if len(sure) == 1 else "",
    )


def _finding(results: TaskResults, ranked: Ranked, *, told: bool) -> Finding:
    best, second = ranked[0], _next(ranked)
    text = f"{best.label} {_mean(results, best)}"
    if second is not None:
        text += f", next {second.label} {_mean(results, second)}{_margin(results, second)}"
    text += _beside(results, best.label) + ("" if told else f"; {_sure(ranked)}")
    return Finding(slug("task", results.layout.name), results.layout.page.short, text)


def _next(ranked: Ranked) -> Standing | None:
    """Return the best of the others that has every score."""
    return next((other for other in ranked[1:] if other.complete), None)


def _mean(results: TaskResults, standing: Standing) -> str:
    return number(standing.mean, results.decimals[first_metric(results)])


def _margin(results: TaskResults, second: Standing) -> str:
    if math.isnan(second.low):
        return ""
    places = results.decimals[first_metric(results)]
    low, high = number(second.low, places), number(second.high, places)
    return f" (behind by {low} to {high})"


def _sure(ranked: Ranked) -> str:
    """Return what the test says of the lead."""
    second = _next(ranked)
    return second.finding if second else "no rival"


def _beside(results: TaskResults, best: str) -> str:
    """Return a clause on the reference where no model is better than it."""
    cell, reference = board_cells(results)[best], reference_of(results)
    return f"; no better than {reference}" if cell.beaten and reference else ""
