"""The page: one HTML file that contains everything and needs no network."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from importlib.resources import files

from jinja2 import Environment, FunctionLoader, StrictUndefined, Template
from markupsafe import Markup

from mocapbench.reports.analysis.results import task_results
from mocapbench.reports.analysis.troubles import DATA_MISSING, troubles
from mocapbench.reports.bundle.bundle import STATUSES, Bundle
from mocapbench.reports.page.downloads import to_csv, to_latex
from mocapbench.reports.page.missing_data import missing_data
from mocapbench.reports.page.sections import overall_ranks, task_view
from mocapbench.reports.paper.citations import citations_of
from mocapbench.reports.tables.base import Table
from mocapbench.reports.tables.check import check_table
from mocapbench.reports.tables.papers import papers_table
from mocapbench.reports.tables.score_cells import MISSING_ID
from mocapbench.reports.text import counted, slug

__all__ = ["render"]

STYLES = ("report.css", "styles/player.css")
SCRIPTS = ("report.js", "scripts/bodies.js", "scripts/player.js")


def render(bundle: Bundle) -> str:
    """Return the report as one self-contained HTML page; the same bundle gives the same bytes."""
    results = [task_results(bundle, layout) for layout in bundle.layouts]
    tasks = [task_view(of_task, bundle.illustrations) for of_task in results]
    no_score = troubles(bundle)
    check = check_table(bundle.check) if bundle.check else None
    papers = papers_table(results)
    tables = [*(table for task in tasks for table in task.tables), check, papers]
    return _template().render(
        bundle=bundle,
        provenance=bundle.provenance,
        tasks=tasks,
        overall=overall_ranks(results),
        statuses=_statuses(bundle),
        entrants=bundle.records["label"].nunique(),
        folds=bundle.records["fold"].nunique(),
        fold_counts=_fold_counts(bundle),
        failures=[trouble for trouble in no_score if trouble.status != DATA_MISSING],
        missing=missing_data(trouble for trouble in no_score if trouble.status == DATA_MISSING),
        missing_id=MISSING_ID,
        check_table=check,
        papers_table=papers,
        citations=citations_of(layout.page.reference for layout in bundle.layouts),
        downloads=_downloads(table for table in tables if table is not None),
        css=Markup("".join(map(_resource, STYLES))),
        js=Markup("".join(map(_resource, SCRIPTS))),
    )


def _template() -> Template:
    environment = Environment(
        autoescape=True,
        loader=FunctionLoader(_resource),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.globals["slug"] = slug
    environment.filters["counted"] = counted
    return environment.get_template("report.html.j2")


def _resource(name: str) -> str:
    return (files(__package__) / name).read_text(encoding="utf-8")


def _statuses(bundle: Bundle) -> dict[str, int]:
    counts = Counter(bundle.records["status"])
    return {status: counts[status] for status in STATUSES if counts[status]}


def _fold_counts(bundle: Bundle) -> str:
    """Return how many folds the cases with scores have, for example "1, 3 or 12 folds"."""
    done = bundle.records[bundle.records["status"] == "ok"]
    *most, last = sorted(set(done.groupby(["task", "case"])["fold"].nunique())) or [0]
    others = ", ".join(map(str, most))
    return f"{others} or {counted(last, 'fold')}" if most else counted(last, "fold")


def _downloads(tables: Iterable[Table]) -> dict[str, dict[str, str]]:
    return {table.id: {"csv": to_csv(table), "tex": to_latex(table)} for table in tables}
