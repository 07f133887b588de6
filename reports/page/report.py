"""The page: one HTML file that contains everything and needs no network."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import groupby

from mocapbench.metrics.statistics import FEWEST_UNITS
from mocapbench.reports.analysis.comparisons import RELATIVE_TOLERANCE
from mocapbench.reports.analysis.results import (
    DATA_MISSING,
    TaskResults,
    list_failures,
    task_results,
)
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.bundle.model_info import ModelInfo, in_families
from mocapbench.reports.bundle.task_page import QUESTIONS
from mocapbench.reports.figures.styles import model_styles
from mocapbench.reports.front.answers import answers
from mocapbench.reports.front.scoreboard import SHADES, scoreboard
from mocapbench.reports.front.trust import trust
from mocapbench.reports.page.cell_dialog import cells_json
from mocapbench.reports.page.facts import facts
from mocapbench.reports.page.notes import missing_data, shared_notes
from mocapbench.reports.page.sections import Part, task_section
from mocapbench.reports.paper.citations import citations_of
from mocapbench.reports.resources import digest_of_script, fill_template, scripts, styles
from mocapbench.reports.tables.check import check_table
from mocapbench.reports.tables.papers import papers_table

__all__ = ["render"]

Families = Mapping[str, Sequence[str]]


def render(bundle: Bundle) -> str:
    """Return the report as one self-contained HTML page; the same bundle gives the same bytes."""
    results = sorted((task_results(bundle, layout) for layout in bundle.layouts), key=_place)
    families = in_families(_models(results))
    js = scripts()
    return fill_template(
        "parts/page.html.j2",
        bundle=bundle,
        metrics=bundle.metrics,
        provenance=bundle.provenance,
        **_front(bundle, results, families),
        **_tasks(bundle, results),
        **_families(families),
        **_without_score(bundle),
        facts=facts(bundle),
        fewest_units=FEWEST_UNITS,
        tolerance=f"{100 * RELATIVE_TOLERANCE:g} %",
        check_table=check_table(bundle.check) if bundle.check else None,
        papers_table=papers_table(results),
        citations=citations_of(layout.page.reference for layout in bundle.layouts),
        cells=cells_json(results, bundle.origins),
        css=styles(),
        js=js,
        js_digest=digest_of_script(js),
    )


def _front(bundle: Bundle, results: Sequence[TaskResults], families: Families) -> Part:
    return {
        "trust": trust(bundle, results),
        "answers": answers(results),
        "board": scoreboard(results, families),
        "shades": [name for _, name in SHADES],
    }


def _tasks(bundle: Bundle, results: Sequence[TaskResults]) -> Part:
    looks = model_styles(bundle.layouts)
    shared = shared_notes([of_task.layout for of_task in results])
    elsewhere = {remark for notes in shared for remark in notes["remarks"]}
    sections = [task_section(of_task, bundle, looks, elsewhere) for of_task in results]
    return {"tasks": sections, "by_question": _by_question(sections), "shared_notes": shared}


def _families(families: Families) -> Part:
    labels = [label for labels in families.values() for label in labels]
    return {"families": list(families), "labels": labels}


def _without_score(bundle: Bundle) -> Part:
    """Return the jobs that failed, and those that lacked recordings."""
    no_score = list_failures(bundle)
    without_data = no_score["status"] == DATA_MISSING
    return {
        "failures": list(no_score[~without_data].itertuples()),
        "missing": missing_data(no_score[without_data]),
    }


def _place(results: TaskResults) -> int:
    """Return the place of a task's question on the page."""
    return list(QUESTIONS).index(results.layout.page.question)


def _by_question(sections: Sequence[Part]) -> list[tuple[str, list[Part]]]:
    groups = groupby(sections, key=lambda section: section["layout"].page.question)
    return [(QUESTIONS[name][0], list(group)) for name, group in groups]


def _models(results: Sequence[TaskResults]) -> Mapping[str, ModelInfo]:
    """Return the model behind every label of the page."""
    return {label: task.layout.model(label) for task in results for label in task.layout.labels}
