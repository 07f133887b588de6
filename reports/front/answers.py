"""A sentence for each question: which model, by what margin, and how sure."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from mocapbench.basics.words import format_count
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import Place, standings
from mocapbench.reports.bundle.questions import QUESTIONS, Question
from mocapbench.reports.front.board_cells import first_metric
from mocapbench.reports.front.findings import RankedTask, TaskFinding

__all__ = ["TESTED", "QuestionAnswer", "answers"]

TESTED = (Place.BEHIND, Place.INSEPARABLE)
OF_TOYS = "recover"
"""A question that only generated data can answer, and no user asks."""
NO_RIVAL = "no rival"


@dataclass(frozen=True)
class QuestionAnswer:
    """What the run says to one question.

    Parameters
    ----------
    question, ask : str
        Its title, and the question in one sentence.
    model : str
        The model that alone is best in more than half of its tasks, and there better than the
        reference; empty where none is.
    doubt : str
        What the tests say of its leads; empty where more than half of its tasks show a lead that is
        more than chance.
    findings : tuple of TaskFinding
        One for each task, those that ``model`` leads first.
    sure : str
        What the tests say of the leads.
    """

    question: str
    ask: str
    model: str
    doubt: str
    findings: tuple[TaskFinding, ...]
    sure: str


def answers(tasks: Sequence[TaskResults]) -> list[QuestionAnswer]:
    """Return an answer for each question that a task with a ranked score puts."""
    standing = [(task, standings(task, first_metric(task))) for task in tasks]
    ranked = [RankedTask(task, found) for task, found in standing if found]
    return [
        _answer(each, group)
        for each in QUESTIONS
        if each.name != OF_TOYS
        and (group := [one for one in ranked if one.results.layout.page.question == each.name])
    ]


def _answer(question: Question, group: Sequence[RankedTask]) -> QuestionAnswer:
    leaders = Counter(one.best.label for one in group if not one.level and not one.beaten)
    model, most = leaders.most_common(1)[0] if leaders else ("", 0)
    named = model if 2 * most > len(group) else ""
    first = sorted(group, key=lambda one: one.best.label != named)
    return QuestionAnswer(
        question.title,
        question.ask,
        named,
        _doubt(named, group) if named else "",
        tuple(one.finding for one in first),
        _sure([one.lead for one in first if not one.level]),
    )


def _doubt(model: str, group: Sequence[RankedTask]) -> str:
    """Return why it is not shown that ``model`` is best in more than half of the tasks."""
    leads = [one.lead for one in group if one.best.label == model and not one.level]
    if 2 * leads.count(Place.BEHIND) > len(group):
        return ""
    doubts = [place.value for place in (Place.INSEPARABLE, Place.UNTESTED) if place in leads]
    return next(iter(doubts), NO_RIVAL)


def _sure(leads: Sequence[Place | None]) -> str:
    """Return how many leads are more than chance, how many may be chance, how many not tested."""
    counts = [(leads.count(place), place) for place in (*TESTED, Place.UNTESTED)]
    parts = "; ".join(f"{count} {place.value}" for count, place in counts if count)
    alone = NO_RIVAL if leads else "no lead"
    return f"{format_count(len(leads), 'lead')}: {parts}" if parts else alone
