"""The sections of the page: the tables, figures and headlines of each task."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import dataclass

from mocapbench.reports.analysis.ranks import ranks_over_units
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import TaskLayout
from mocapbench.reports.bundle.pictures import Picture
from mocapbench.reports.figures.pictures.draw import draw
from mocapbench.reports.figures.scores.along import curves_along
from mocapbench.reports.figures.scores.dots import dot_plot
from mocapbench.reports.figures.scores.ranks import rank_figure
from mocapbench.reports.figures.styles import Style
from mocapbench.reports.figures.svg_figure import SvgFigure
from mocapbench.reports.motions.player import PlayerFigure
from mocapbench.reports.page.headline import Headline
from mocapbench.reports.page.lead_headlines import lead_headlines
from mocapbench.reports.page.notes import task_notes
from mocapbench.reports.page.published_headlines import published_headlines
from mocapbench.reports.page.win_headlines import win_headlines
from mocapbench.reports.scores.build import score_table
from mocapbench.reports.scores.table import ScoreTable
from mocapbench.reports.tables.base import Table
from mocapbench.reports.tables.best_reference import best_reference_table
from mocapbench.reports.tables.calibration import calibration_table
from mocapbench.reports.tables.contrasts import contrast_table
from mocapbench.reports.tables.cost import cost_table
from mocapbench.reports.tables.crossed import cross_table
from mocapbench.reports.tables.negative_control import negative_control_table
from mocapbench.reports.tables.oracle import oracle_table
from mocapbench.reports.tables.verdicts import verdict_table
from mocapbench.reports.text import slug

__all__ = ["MetricView", "TaskView", "task_view"]

SUMMARIES = (
    best_reference_table,
    oracle_table,
    negative_control_table,
    calibration_table,
    cost_table,
)


@dataclass(frozen=True, eq=False)
class MetricView:
    """The scores of a task by one metric: a table of scores, or one of pairs (``crossed``)."""

    title: str
    scores: ScoreTable | None
    crossed: Table | None


@dataclass(frozen=True, eq=False)
class TaskView:
    """One section of the page.

    Parameters
    ----------
    id : str
        Anchor of the section.
    layout : TaskLayout
    leads, wins : sequence of Headline
        On the best means, and on models that the paper lacks.
    metrics : sequence of MetricView
        The first is shown open.
    figures : sequence of SvgFigure
        Of the first metric.
    players : sequence of PlayerFigure
        Of motions of one solved problem.
    pictures : sequence of SvgFigure
        Other pictures of one solved problem, folded.
    summaries : sequence of Table
        What else there is to know, folded.
    not_run : sequence of str
        Headings of the cases that did not run.
    notes : sequence of str
        Remarks, errata and reasons against comparisons, each once for all tables of the task.
    """

    id: str
    layout: TaskLayout
    leads: Sequence[Headline]
    wins: Sequence[Headline]
    metrics: Sequence[MetricView]
    figures: Sequence[SvgFigure]
    players: Sequence[PlayerFigure]
    pictures: Sequence[SvgFigure]
    summaries: Sequence[Table]
    not_run: Sequence[str]
    notes: Sequence[str]

    @property
    def first(self) -> MetricView:
        """The metric that is shown open."""
        return self.metrics[0]

    @property
    def others(self) -> Sequence[MetricView]:
        """The metrics that are folded."""
        return self.metrics[1:]


def task_view(
    results: TaskResults,
    styles: Mapping[str, Style],
    illustrations: Iterable[Picture] = (),
    shared: Container[str] = (),
) -> TaskView:
    """Return the section of one task, with the ``illustrations`` that belong to it.

    Remarks that are ``shared`` with other tasks stand elsewhere.
    """
    layout, first = results.layout, results.layout.page.metrics[0]
    ran = {case.name for case in results.cases}
    pictures = [draw(picture, styles) for picture in illustrations if picture.task == layout.name]
    return TaskView(
        id=slug("task", layout.name),
        layout=layout,
        leads=[*lead_headlines(results, first), *published_headlines(results, first)],
        wins=win_headlines(results, first),
        metrics=[_metric_view(results, metric, styles) for metric in layout.page.metrics],
        figures=_figures(results, first, styles),
        players=[drawn for drawn in pictures if isinstance(drawn, PlayerFigure)],
        pictures=[
            *_folded(results, first, styles),
            *(drawn for drawn in pictures if isinstance(drawn, SvgFigure)),
        ],
        summaries=_summaries(results, first),
        not_run=[case.heading for case in layout.cases if case.name not in ran],
        notes=task_notes(results, shared),
    )


def _metric_view(results: TaskResults, metric: str, styles: Mapping[str, Style]) -> MetricView:
    crossed, title = results.layout.page.crossed, results.metrics[metric].title
    if crossed:
        return MetricView(title, None, cross_table(results, metric, crossed))
    return MetricView(title, score_table(results, metric, styles), None)


def _figures(results: TaskResults, metric: str, styles: Mapping[str, Style]) -> list[SvgFigure]:
    """Return curves along a column where the page names one, and ranks where these separate."""
    along = results.layout.page.along
    curves = curves_along(results, metric, along, styles) if along else None
    ranks, title = ranks_over_units(results, metric), results.metrics[metric].title
    diagram = rank_figure(ranks, f"{title}, ranks over {ranks.unit}s", styles) if ranks else None
    return [figure for figure in (curves, diagram) if figure is not None]


def _folded(results: TaskResults, metric: str, styles: Mapping[str, Style]) -> list[SvgFigure]:
    """Return the scores case by case, unless they stand along a column or are of pairs."""
    page = results.layout.page
    plot = None if page.along or page.crossed else dot_plot(results, metric, styles)
    return [] if plot is None else [plot]


def _summaries(results: TaskResults, first: str) -> list[Table]:
    published = [verdict_table(results, metric) for metric in results.layout.page.metrics]
    built = [contrast_table(results, first), *published, *(build(results) for build in SUMMARIES)]
    return [table for table in built if table is not None]
