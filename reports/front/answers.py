"""A sentence for each question: which model, by what margin, and how sure.

What many people are asked comes first. The protocols of papers, which have few, stand below it as
reproductions, with what was published.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from mocapbench.basics.words import format_count, join_names
from mocapbench.metrics.base import Direction
from mocapbench.reports.analysis.comparisons import count_by_source
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.analysis.standings import (
    MOST_LEVEL,
    Place,
    Standing,
    level_with_best,
    next_best,
    standings,
)
from mocapbench.reports.bundle.layout import CaseLayout
from mocapbench.reports.bundle.task_page import QUESTIONS
from mocapbench.reports.front.scoreboard import (
    LONGEST_UNIT,
    board_cells,
    first_metric,
    is_generated,
    reference_of,
)
from mocapbench.reports.text import apart, number, slug

__all__ = ["answers"]

OF_TOYS = "recover"
"""A question that only generated data can answer, and no user asks."""
NO_RIVAL = "no rival"
NOT_TESTED = ("not comparable", "not run")
"""Verdicts on published values that have none of ours beside them."""
COMPARED: Mapping[Direction, str] = {
    Direction.LOWER: "less than",
    Direction.HIGHER: "more than",
    Direction.TARGET: "nearer than",
}

Finding = tuple[TaskResults, str, Sequence[Standing], str]
"""A task, what it asks, its standings by its first metric, best first, one or more, and the task's
reference if the best is no better, with its mean, empty if it is.
"""


def answers(tasks: Sequence[TaskResults]) -> list[dict[str, Any]]:
    """Return an answer for each question that a task with a ranked score puts.

    Returns
    -------
    list of dict
        ``question``, the title of it; ``model``, which alone is best in more than half of what
        many people are asked, or of all tasks where they are asked nothing, and there better than
        the reference, empty where none is; ``doubt``, what the tests say of its leads, empty where
        more than half show a lead that is more than chance; ``findings``, the anchor, the title and
        a sentence of each, those that the model leads first; ``reproductions``, the same of tasks
        with published values; ``sure``, what the tests say of all leads.
    """
    found = [finding for task in tasks for finding in _find(task)]
    return [
        _answer(title, group)
        for name, (title, _) in QUESTIONS.items()
        if name != OF_TOYS and (group := [one for one in found if _question(one) == name])
    ]


def _find(results: TaskResults) -> list[Finding]:
    """Return what a task says: of each case that many people are asked, else of all cases."""
    metric, asks = first_metric(results), results.layout.page.asks
    asked: list[tuple[str, list[CaseLayout] | None]] = [
        (asks[case.name] + _mark_generated(results), [case])
        for case in results.representative_cases(metric)
        if case.name in asks
    ]
    whole = [(results.layout.page.short + _mark_generated(results), None)]
    rivals = _leave_out_choosers(results)
    found = [(text, cases, standings(rivals, metric, cases)) for text, cases in asked or whole]
    return [
        (results, text, ranked, _find_better(_keep_cases(rivals, cases), ranked[0].label))
        for text, cases, ranked in found
        if ranked
    ]


def _keep_cases(results: TaskResults, cases: Sequence[CaseLayout] | None) -> TaskResults:
    """Return the results of some cases, of all if none are named."""
    kept = results.layout.cases if cases is None else tuple(cases)
    return replace(results, layout=replace(results.layout, cases=kept))


def _find_better(results: TaskResults, label: str) -> str:
    """Return the reference and its mean if a label, the best, is no better; else nothing."""
    cells, name = board_cells(results), reference_of(results)
    return f"{name}, {cells[name].text}" if name and cells[label].beaten else ""


def _leave_out_choosers(results: TaskResults) -> TaskResults:
    """Return the results without models that choose or average others: these are no rivals."""
    layout = results.layout
    single = tuple(label for label in layout.labels if not layout.model(label).is_several)
    return replace(results, layout=replace(layout, labels=single or layout.labels))


def _mark_generated(results: TaskResults) -> str:
    return " (synthetic)" if is_generated(results) else ""


def _question(finding: Finding) -> str:
    return finding[0].layout.page.question


def _answer(question: str, group: Sequence[Finding]) -> dict[str, Any]:
    papers = [finding for finding in group if finding[0].published]
    deciding = [finding for finding in group if finding[0].layout.page.asks] or group
    leaders = Counter(filter(None, map(_find_leader, deciding)))
    model, most = leaders.most_common(1)[0] if leaders else ("", 0)
    named = model if 2 * most > len(deciding) else ""
    alone = [finding for finding in group if not level_with_best(finding[2])]
    first, below = (
        sorted(some, key=lambda finding: finding[2][0].label != named)
        for some in ([one for one in group if one not in papers], papers)
    )
    return {
        "question": question,
        "model": named,
        "doubt": _doubt(named, deciding) if named else "",
        "findings": [(*_head(one), _describe(one)) for one in first],
        "reproductions": [(*_head(one), _describe(one) + _count_published(one)) for one in below],
        "sure": _sure([_lead(finding) for finding in alone]),
    }


def _find_leader(finding: Finding) -> str:
    """Return the model that alone is best, and better than the reference; empty without one."""
    _, _, found, better = finding
    return "" if level_with_best(found) or better else found[0].label


def _doubt(model: str, deciding: Sequence[Finding]) -> str:
    """Return why it is not shown that ``model`` is best in more than half of the findings."""
    leads = [_lead(finding) for finding in deciding if _find_leader(finding) == model]
    if 2 * leads.count(Place.BEHIND) > len(deciding):
        return ""
    doubts = [place.value for place in (Place.INSEPARABLE, Place.UNTESTED) if place in leads]
    return next(iter(doubts), NO_RIVAL)


def _sure(leads: Sequence[Place | None]) -> str:
    """Return how many leads are more than chance, how many may be chance, how many not tested."""
    counts = [
        (leads.count(place), place) for place in (Place.BEHIND, Place.INSEPARABLE, Place.UNTESTED)
    ]
    parts = "; ".join(f"{count} {place.value}" for count, place in counts if count)
    alone = NO_RIVAL if leads else "no lead"
    return f"{format_count(len(leads), 'lead')}: {parts}" if parts else alone


def _lead(finding: Finding) -> Place | None:
    """Return what the test says of the lead; None without a rival."""
    second = next_best(finding[2])
    return second.standing if second else None


def _head(finding: Finding) -> tuple[str, str]:
    """Return the anchor of a task's section, and what is asked."""
    results, asked, _, _ = finding
    return slug("task", results.layout.name), asked


def _describe(finding: Finding) -> str:
    """Return the best model, its mean, and by how much it is better than the next."""
    results, _, found, better = finding
    no_better = f"; no better than {better}" if better else ""
    return _describe_best(results, found) + _describe_lead(results, found) + no_better


def _describe_best(results: TaskResults, found: Sequence[Standing]) -> str:
    best, level = found[0], level_with_best(found)
    names = join_names([one.label for one in [best, *level]], MOST_LEVEL)
    unit = results.metrics[first_metric(results)].unit
    end = f" {unit}" if 0 < len(unit) <= LONGEST_UNIT else ""
    return f"{names}{', alike:' if level else ''} {number(best.mean, _places(results, found))}{end}"


def _describe_lead(results: TaskResults, found: Sequence[Standing]) -> str:
    """Return the difference from the next, its interval, and how many units it is over."""
    second = next_best(found)
    if second is None:
        return ""
    places, metric = _places(results, found), results.metrics[first_metric(results)]
    difference, low, high = (
        number(value, places) for value in (second.difference, second.low, second.high)
    )
    tested = second.standing is not Place.UNTESTED
    sure = f" ({low} to {high})" if tested else ""
    end = "" if second.standing is Place.BEHIND else f": {second.standing.value}"
    compared = f"{COMPARED[metric.direction]} {second.label}"
    return f"; {difference}{sure} {compared}, over {second.units}{end}"


def _places(results: TaskResults, found: Sequence[Standing]) -> int:
    """Return with how many decimals the best differs from the next."""
    second, places = next_best(found), results.decimals[first_metric(results)]
    return places if second is None else apart(found[0].mean, second.mean, places)


def _count_published(finding: Finding) -> str:
    """Return how ours compare with published values of the task."""
    verdicts: Counter[str] = Counter()
    for counts in count_by_source(finding[0]).values():
        verdicts.update(counts)
    shown = [f"{n} {verdict}" for verdict, n in verdicts.items() if n and verdict not in NOT_TESTED]
    return f"; published: {', '.join(shown)}" if shown else ""
