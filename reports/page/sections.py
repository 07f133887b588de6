"""The sections of the page: the tables, figures and headlines of each task."""

from __future__ import annotations

from collections.abc import Container, Mapping
from typing import Any

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.bundle.pictures import Motions
from mocapbench.reports.figures.pictures.draw import draw
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.task_figures import folded_figures, open_figures
from mocapbench.reports.motions.player import player
from mocapbench.reports.page.headlines import lead_headlines, win_headlines
from mocapbench.reports.page.notes import task_notes
from mocapbench.reports.scores.table import score_table
from mocapbench.reports.tables.base import Table
from mocapbench.reports.tables.best_reference import best_reference_table
from mocapbench.reports.tables.by_fold import fold_table
from mocapbench.reports.tables.calibration import calibration_table
from mocapbench.reports.tables.control import negative_control_table
from mocapbench.reports.tables.cost import cost_table
from mocapbench.reports.tables.crossed import cross_table
from mocapbench.reports.tables.oracle import oracle_table
from mocapbench.reports.tables.pairs import contrast_table
from mocapbench.reports.tables.verdicts import verdict_table
from mocapbench.reports.text import slug

__all__ = ["task_section"]

Part = dict[str, Any]
"""What the template reads for one part of the page, by name."""
Styles = Mapping[str, DrawingStyle]

SUMMARIES = (
    best_reference_table,
    oracle_table,
    negative_control_table,
    calibration_table,
    cost_table,
)


def task_section(
    results: TaskResults, bundle: Bundle, styles: Styles, shared: Container[str] = ()
) -> Part:
    """Return the section of one task.

    Parameters
    ----------
    results : TaskResults
    bundle : Bundle
    styles : mapping of str to DrawingStyle
        Of all labels of the page, as `mocapbench.reports.figures.styles.model_styles` returns them.
    shared : container of str
        Remarks that stand elsewhere, as they are on other tasks too.

    Returns
    -------
    dict
        The ``id`` and ``layout``, ``leads`` and ``wins`` as headlines, ``metrics`` as pairs of a
        title and a table, of which the first is shown open, ``figures``, which are open,
        ``players`` of motions, ``pictures`` and ``summaries``, which are folded, the headings of
        cases ``not_run``, and ``notes``.
    """
    layout, first = results.layout, results.layout.page.metrics[0]
    ran = {case.name for case in results.cases}
    own = [picture for picture in bundle.illustrations if picture.task == layout.name]
    pictures = [draw(picture, styles) for picture in own if not isinstance(picture, Motions)]
    return {
        "id": slug("task", layout.name),
        "layout": layout,
        "leads": lead_headlines(results, first),
        "wins": win_headlines(results, first),
        "metrics": [_metric_table(results, metric, styles) for metric in layout.page.metrics],
        "figures": open_figures(results, bundle.parts, styles),
        "players": [player(picture) for picture in own if isinstance(picture, Motions)],
        "pictures": [*folded_figures(results, bundle.parts, styles), *pictures],
        "summaries": _summaries(results, first),
        "not_run": [case.heading for case in layout.cases if case.name not in ran],
        "notes": task_notes(results, shared),
    }


def _metric_table(
    results: TaskResults, metric: str, styles: Styles
) -> tuple[str, dict[str, Any] | Table]:
    """Return the title of a metric and its table: of scores, or of pairs of cases."""
    crossed, title = results.layout.page.crossed, results.metrics[metric].title
    if crossed:
        return title, cross_table(results, metric, crossed)
    return title, score_table(results, metric, styles)


def _summaries(results: TaskResults, first: str) -> list[Table]:
    published = [verdict_table(results, metric) for metric in results.layout.page.metrics]
    pairs = [contrast_table(results, first), fold_table(results, first)]
    built = [*pairs, *published, *(build(results) for build in SUMMARIES)]
    return [table for table in built if table is not None]
