"""The tidy tables of the figures of a run, and which figures it has no data for."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import pandas as pd

from mocapbench.reports.analysis.results import TaskResults, task_results
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.export.paper_table import describe_protocol
from mocapbench.reports.figures.plots.base import NothingToDrawError
from mocapbench.reports.figures.plots.choice import describe_choice
from mocapbench.reports.figures.plots.kinds import FIGURE_KINDS
from mocapbench.reports.text import slug

__all__ = ["describe_figure", "tabulate_figures"]

FigureTables = Mapping[tuple[str, str, str], pd.DataFrame]
"""Tidy tables by task, kind and the name of the figure."""


def tabulate_figures(
    bundle: Bundle, kinds: Sequence[str], metrics: Sequence[str] = ()
) -> tuple[FigureTables, Mapping[tuple[str, str], Sequence[str]]]:
    """Return the tables of all figures, and the tasks without a figure by kind and reason.

    Parameters
    ----------
    bundle : Bundle
        What is shown of a run.
    kinds : sequence of str
        Of `FIGURE_KINDS`.
    metrics : sequence of str, optional
        By default those that the page of a task shows.
    """
    tables: dict[tuple[str, str, str], pd.DataFrame] = {}
    lacking: dict[tuple[str, str], list[str]] = {}
    for layout in bundle.layouts:
        results = task_results(bundle, layout)
        for kind in kinds:
            try:
                found = FIGURE_KINDS[kind].tabulate(bundle, results, metrics)
            except NothingToDrawError as reason:
                lacking.setdefault((kind, str(reason)), []).append(layout.name)
            else:
                names = {part: _name_figure(layout.name, kind, part) for part in found}
                tables |= {(layout.name, kind, names[part]): found[part] for part in found}
    return tables, lacking


def _name_figure(*parts: str) -> str:
    """Return a name for files, of letters, digits and single hyphens."""
    return re.sub("-+", "-", slug(*parts)).strip("-")


def describe_figure(bundle: Bundle, task: str, kind: str, table: pd.DataFrame) -> str:
    """Return a caption: the task with its protocol, and what marks and intervals are."""
    (layout,) = (layout for layout in bundle.layouts if layout.name == task)
    protocol = describe_protocol(layout, bundle.provenance.get("profile", ""))
    about = f"{protocol}{_describe_cases(task_results(bundle, layout))}."
    parts = (about, FIGURE_KINDS[kind].describe(table), describe_choice(table))
    return " ".join(filter(None, parts))


def _describe_cases(results: TaskResults) -> str:
    """Return which case has scores, if it is one alone, and whether all are of generated motion."""
    scored = {case for case, _, _ in results.estimates}
    cases = [case for case in results.cases if case.name in scored]
    name = f", {cases[0].name}" if len(cases) == 1 else ""
    made = bool(cases) and all(case.synthetic for case in cases)
    return name + (", generated motion (synthetic)" if made else "")
