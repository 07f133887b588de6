"""A sentence for each question: which model, by what margin, and how sure."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import Standing, standings
from mocapbench.reports.bundle.questions import QUESTIONS
from mocapbench.reports.front.board_cells import board_cells, first_metric, reference_of
from mocapbench.reports.scores.build import metric_places
from mocapbench.reports.text import counted, number, slug

__all__ = ["Answer", "Finding", "answers"]


@dataclass(frozen=True)
class Finding:
    """What one task says.

    Parameters
    ----------
    id, title : str
        The anchor of the task's section, and its title.
    text : str
        The best model, the next, and the margin.
    sure : str
        Whether the margin may be chance, or is not tested.
    """

    id: str
    title: str
    text: str
    sure: str


@dataclass(frozen=True)
class Answer:
    """What the run says to one question.

    Parameters
    ----------
    question : str
        Its title.
    ask : str
        The question in one sentence.
    models : str
        The model that is best in most of its tasks, or all that are best in as many.
    led : str
        In how many of its tasks.
    findings : tuple of Finding
        One for each task.
    """

    question: str
    ask: str
    models: str
    led: str
    findings: tuple[Finding, ...]


def answers(tasks: Sequence[TaskResults]) -> list[Answer]:
    """Return an answer for each question that a task with a ranked score puts."""
    ranked = [(task, standings(task, first_metric(task))) for task in tasks]
    return [
        _answer(each.title, each.ask, group)
        for each in QUESTIONS
        if (group := [(t, s) for t, s in ranked if s and t.layout.page.question == each.name])
    ]


def _answer(
    title: str, ask: str, group: Sequence[tuple[TaskResults, Sequence[Standing]]]
) -> Answer:
    leaders = Counter(ranked[0].label for _, ranked in group)
    most = max(leaders.values())
    first = [label for label, count in leaders.items() if count == most]
    led = f"best in {most} of {counted(len(group), 'task')}" if len(group) > 1 else ""
    return Answer(
        question=title,
        ask=ask,
        models=first[0] if len(first) == 1 else "no single model",
        led=led if len(first) == 1 else "",
        findings=tuple(_finding(task, ranked) for task, ranked in group),
    )


def _finding(results: TaskResults, ranked: Sequence[Standing]) -> Finding:
    best, *others = ranked
    second = next((other for other in others if other.complete), None)
    text = f"{best.label} {_mean(results, best)}"
    if second is not None:
        text += f", next {second.label} {_mean(results, second)}{_margin(results, second)}"
    return Finding(
        slug("task", results.layout.name),
        results.layout.page.title,
        text + _beside(results, best.label),
        second.finding if second else "nothing to compare with",
    )


def _mean(results: TaskResults, standing: Standing) -> str:
    return number(standing.mean, metric_places(results, first_metric(results)))


def _margin(results: TaskResults, second: Standing) -> str:
    if math.isnan(second.low):
        return ""
    places = metric_places(results, first_metric(results))
    low, high = number(second.low, places), number(second.high, places)
    return f" (+{number(second.difference, places)}, {low} to {high})"


def _beside(results: TaskResults, best: str) -> str:
    """Return a clause on the reference where no model is better than it."""
    cell, reference = board_cells(results)[best], reference_of(results)
    return f"; no better than {reference}" if cell.beaten and reference else ""
