"""The sections of the page: the tables, figures and headlines of each task."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from mocapbench.reports.analysis.published.totals import Tally, tally
from mocapbench.reports.analysis.ranks import ranks_over_tasks, ranks_over_units
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.layout import TaskLayout
from mocapbench.reports.bundle.pictures import Picture
from mocapbench.reports.figures.along import curves_along
from mocapbench.reports.figures.draw import draw
from mocapbench.reports.figures.error_bars import error_bars
from mocapbench.reports.figures.ranks import rank_figure
from mocapbench.reports.figures.svg_figure import SvgFigure
from mocapbench.reports.page.headline import Headline
from mocapbench.reports.page.lead_headlines import lead_headlines
from mocapbench.reports.page.published_headlines import published_headlines
from mocapbench.reports.page.win_headlines import win_headlines
from mocapbench.reports.tables.base import Table
from mocapbench.reports.tables.best_reference import best_reference_table
from mocapbench.reports.tables.calibration import calibration_table
from mocapbench.reports.tables.contrasts import contrast_table
from mocapbench.reports.tables.cost import cost_table
from mocapbench.reports.tables.crossed import cross_table
from mocapbench.reports.tables.negative_control import negative_control_table
from mocapbench.reports.tables.oracle import oracle_table
from mocapbench.reports.tables.scores import score_table
from mocapbench.reports.tables.verdicts import verdict_table
from mocapbench.reports.text import slug

__all__ = ["MetricView", "TaskView", "overall_ranks", "task_view"]

SUMMARIES = (
    best_reference_table,
    oracle_table,
    negative_control_table,
    calibration_table,
    cost_table,
)


@dataclass(frozen=True, eq=False)
class MetricView:
    """One metric of a task: its table, figures, contrasts, and the published values beside ours."""

    title: str
    table: Table
    figure: SvgFigure | None
    published: Table | None
    ranks: SvgFigure | None
    contrasts: Table | None


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
    verdicts : Tally
        Of the published values of the task.
    metrics : sequence of MetricView
    figures : sequence of SvgFigure
        The pictures of the task.
    summaries : sequence of Table
        Tables over all cases.
    cases, not_run : sequence of str
        Headings of the cases that ran and of those that did not.
    """

    id: str
    layout: TaskLayout
    leads: Sequence[Headline]
    wins: Sequence[Headline]
    verdicts: Tally
    metrics: Sequence[MetricView]
    figures: Sequence[SvgFigure]
    summaries: Sequence[Table]
    cases: Sequence[str]
    not_run: Sequence[str]

    @property
    def tables(self) -> list[Table]:
        """Every table of the section."""
        of_metrics = [
            table for view in self.metrics for table in (view.table, view.contrasts, view.published)
        ]
        return [table for table in [*of_metrics, *self.summaries] if table is not None]


def task_view(results: TaskResults, illustrations: Iterable[Picture] = ()) -> TaskView:
    """Return the section of one task, with the ``illustrations`` that belong to it."""
    layout, first = results.layout, results.layout.page.metrics[0]
    summaries = [build(results) for build in SUMMARIES]
    ran = {case.name for case in results.cases}
    return TaskView(
        id=slug("task", layout.name),
        layout=layout,
        leads=[*lead_headlines(results, first), *published_headlines(results, first)],
        wins=win_headlines(results, first),
        verdicts=tally(results),
        metrics=[_metric_view(results, metric) for metric in layout.page.metrics],
        figures=[draw(picture) for picture in illustrations if picture.task == layout.name],
        summaries=[table for table in summaries if table is not None],
        cases=[case.heading for case in results.cases],
        not_run=[case.heading for case in layout.cases if case.name not in ran],
    )


def _metric_view(results: TaskResults, metric: str) -> MetricView:
    crossed = results.layout.page.crossed
    return MetricView(
        title=results.metrics[metric].title,
        table=cross_table(results, metric, crossed) if crossed else score_table(results, metric),
        figure=None if crossed else _figure(results, metric),
        published=verdict_table(results, metric),
        ranks=_rank_figure(results, metric),
        contrasts=contrast_table(results, metric),
    )


def _figure(results: TaskResults, metric: str) -> SvgFigure | None:
    """Return curves along a column where the page names one and enough of it ran, else points."""
    along = results.layout.page.along
    curves = curves_along(results, metric, along) if along else None
    return curves or error_bars(results, metric)


def _rank_figure(results: TaskResults, metric: str) -> SvgFigure | None:
    ranks, title = ranks_over_units(results, metric), results.metrics[metric].title
    name = slug(results.layout.name, metric)
    return rank_figure(ranks, f"{title}, ranks over {ranks.unit}s", name) if ranks else None


def overall_ranks(tasks: Sequence[TaskResults]) -> list[SvgFigure]:
    """Return a diagram of the ranks over tasks, for each kind of task that has enough of them."""
    kinds = dict.fromkeys(task.layout.page.kind for task in tasks)
    by_kind = {k: ranks_over_tasks(t for t in tasks if t.layout.page.kind == k) for k in kinds}
    return [
        rank_figure(ranks, f"Tasks that {kind}, ranks over tasks", slug("overall", kind))
        for kind, ranks in by_kind.items()
        if ranks
    ]
