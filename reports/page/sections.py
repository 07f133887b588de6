"""The sections of the page: the tables, figures and headlines of each task."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from mocapbench.reports.analysis.comparisons import Tally, comparisons, every_comparison, tally
from mocapbench.reports.analysis.ranks import ranks_over_cases, ranks_over_tasks
from mocapbench.reports.analysis.results import TaskResults
from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.bundle.layout import TaskLayout
from mocapbench.reports.figures.scores.along import curves_along
from mocapbench.reports.figures.scores.dots import dot_plot
from mocapbench.reports.figures.scores.ranks import rank_figure
from mocapbench.reports.figures.styles import Style
from mocapbench.reports.figures.svg_figure import SvgFigure
from mocapbench.reports.figures.task_figures import task_figures
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

Styles = Mapping[str, Style]

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
    verdicts: Tally
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
        Over all metrics.
    metrics : sequence of MetricView
    figures : sequence of SvgFigure
        Of the task as a whole, and its pictures.
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


def task_view(results: TaskResults, bundle: Bundle, styles: Styles) -> TaskView:
    """Return the section of one task.

    Parameters
    ----------
    results : TaskResults
    bundle : Bundle
    styles : mapping of str to Style
        Of all labels of the page, as `mocapbench.reports.figures.styles.model_styles` returns them.
    """
    layout, first = results.layout, results.layout.page.metrics[0]
    summaries = [build(results) for build in SUMMARIES]
    ran = {case.name for case in results.cases}
    return TaskView(
        id=slug("task", layout.name),
        layout=layout,
        leads=[*lead_headlines(results, first), *published_headlines(results, first)],
        wins=win_headlines(results, first),
        verdicts=tally(every_comparison(results)),
        metrics=[_metric_view(results, metric, styles) for metric in layout.page.metrics],
        figures=task_figures(results, bundle, styles),
        summaries=[table for table in summaries if table is not None],
        cases=[case.heading for case in results.cases],
        not_run=[case.heading for case in layout.cases if case.name not in ran],
    )


def _metric_view(results: TaskResults, metric: str, styles: Styles) -> MetricView:
    crossed = results.layout.page.crossed
    return MetricView(
        title=results.metrics[metric].title,
        table=cross_table(results, metric, crossed) if crossed else score_table(results, metric),
        figure=None if crossed else _figure(results, metric, styles),
        published=verdict_table(results, metric),
        verdicts=tally(comparisons(results, metric)),
        ranks=_rank_figure(results, metric, styles),
        contrasts=contrast_table(results, metric),
    )


def _figure(results: TaskResults, metric: str, styles: Styles) -> SvgFigure | None:
    """Return curves along a column where the page names one; else the first metric by case."""
    along, metrics = results.layout.page.along, results.layout.page.metrics
    if along:
        return curves_along(results, metric, along, styles)
    return dot_plot(results, metric, styles) if metric == metrics[0] else None


def _rank_figure(results: TaskResults, metric: str, styles: Styles) -> SvgFigure | None:
    ranks, title = ranks_over_cases(results, metric), results.metrics[metric].title
    return rank_figure(ranks, f"{title}, ranks over cases", styles) if ranks else None


def overall_ranks(tasks: Sequence[TaskResults], styles: Styles) -> list[SvgFigure]:
    """Return a diagram of the ranks over tasks, for each kind of task that has enough of them."""
    kinds = dict.fromkeys(task.layout.page.kind for task in tasks)
    by_kind = {k: ranks_over_tasks(t for t in tasks if t.layout.page.kind == k) for k in kinds}
    return [
        rank_figure(ranks, f"Tasks that {kind}, ranks over tasks", styles)
        for kind, ranks in by_kind.items()
        if ranks
    ]
