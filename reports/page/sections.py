"""The sections of the page: the tables, figures and headlines of each task."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass

from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.bundle.layout import TaskLayout
from mocapbench.reports.figures.pictures.draw import draw
from mocapbench.reports.figures.styles import DrawingStyle
from mocapbench.reports.figures.svg_figure import SvgFigure
from mocapbench.reports.figures.task_figures import folded_figures, open_figures
from mocapbench.reports.motions.player import PlayerFigure
from mocapbench.reports.page.headline import Headline
from mocapbench.reports.page.lead_headlines import lead_headlines
from mocapbench.reports.page.notes import task_notes
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

Styles = Mapping[str, DrawingStyle]

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
        Shown open.
    players : sequence of PlayerFigure
        Of motions of one solved problem.
    pictures : sequence of SvgFigure
        Figures that are folded.
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
    results: TaskResults, bundle: Bundle, styles: Styles, shared: Container[str] = ()
) -> TaskView:
    """Return the section of one task.

    Parameters
    ----------
    results : TaskResults
    bundle : Bundle
    styles : mapping of str to DrawingStyle
        Of all labels of the page, as `mocapbench.reports.figures.styles.model_styles` returns them.
    shared : container of str
        Remarks that stand elsewhere, as they are on other tasks too.
    """
    layout, first = results.layout, results.layout.page.metrics[0]
    ran = {case.name for case in results.cases}
    own = (picture for picture in bundle.illustrations if picture.task == layout.name)
    pictures = [draw(picture, styles) for picture in own]
    return TaskView(
        id=slug("task", layout.name),
        layout=layout,
        leads=lead_headlines(results, first),
        wins=win_headlines(results, first),
        metrics=[_metric_view(results, metric, styles) for metric in layout.page.metrics],
        figures=open_figures(results, bundle.parts, styles),
        players=[drawn for drawn in pictures if isinstance(drawn, PlayerFigure)],
        pictures=[
            *folded_figures(results, bundle.parts, styles),
            *(drawn for drawn in pictures if isinstance(drawn, SvgFigure)),
        ],
        summaries=_summaries(results, first),
        not_run=[case.heading for case in layout.cases if case.name not in ran],
        notes=task_notes(results, shared),
    )


def _metric_view(results: TaskResults, metric: str, styles: Styles) -> MetricView:
    crossed, title = results.layout.page.crossed, results.metrics[metric].title
    if crossed:
        return MetricView(title, None, cross_table(results, metric, crossed))
    return MetricView(title, score_table(results, metric, styles), None)


def _summaries(results: TaskResults, first: str) -> list[Table]:
    published = [verdict_table(results, metric) for metric in results.layout.page.metrics]
    built = [contrast_table(results, first), *published, *(build(results) for build in SUMMARIES)]
    return [table for table in built if table is not None]
