"""The sections of the page: what each task shows, assembled from its results."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from mocapbench.reports.analysis.ranks import ranks_over_cases, ranks_over_tasks
from mocapbench.reports.analysis.results import TaskResults, Trouble
from mocapbench.reports.analysis.verdicts import Tally, comparisons, every_comparison, tally
from mocapbench.reports.bundle.bundle import TaskLayout
from mocapbench.reports.bundle.pictures import Picture
from mocapbench.reports.figures.draw import draw
from mocapbench.reports.figures.error_bars import ErrorBars, error_bars
from mocapbench.reports.figures.panels import Drawing
from mocapbench.reports.figures.ranks import rank_figure
from mocapbench.reports.page.headlines import Finding, lead_findings, printed_findings, win_findings
from mocapbench.reports.tables.base import Table, slug
from mocapbench.reports.tables.best_reference import match_table
from mocapbench.reports.tables.contrasts import contrast_table
from mocapbench.reports.tables.control import control_table
from mocapbench.reports.tables.crossed import cross_table
from mocapbench.reports.tables.scores import case_name, score_table
from mocapbench.reports.tables.summaries import calibration_table, cost_table, oracle_table
from mocapbench.reports.tables.verdicts import verdict_table

__all__ = ["MetricView", "MissingData", "TaskView", "missing_data", "overall_ranks", "task_view"]


@dataclass(frozen=True, eq=False)
class MetricView:
    """One metric of a task: its table, figures, contrasts, and the published values beside ours."""

    title: str
    table: Table
    figure: ErrorBars | None
    published: Table | None
    verdicts: Tally
    ranks: Drawing | None
    contrasts: Table | None


@dataclass(frozen=True, eq=False)
class TaskView:
    """One section of the page."""

    id: str
    layout: TaskLayout
    leads: Sequence[Finding]
    wins: Sequence[Finding]
    verdicts: Tally
    metrics: Sequence[MetricView]
    drawings: Sequence[Drawing]
    summaries: Sequence[Table]
    cases: Sequence[str]
    not_run: Sequence[str]

    @property
    def tables(self) -> list[Table]:
        """Every table of the section."""
        pairs = [
            each for view in self.metrics for each in (view.table, view.contrasts, view.published)
        ]
        return [table for table in [*pairs, *self.summaries] if table is not None]


@dataclass(frozen=True)
class MissingData:
    """Jobs that want for the same data: what to do, and which cases wait for it."""

    message: str
    cases: tuple[str, ...]
    jobs: int


def task_view(results: TaskResults, illustrations: Iterable[Picture] = ()) -> TaskView:
    """Return the section of one task, with those of the ``illustrations`` that are its own."""
    layout, first = results.layout, results.layout.metrics[0]
    builders = (match_table, oracle_table, control_table, calibration_table, cost_table)
    summaries = [build(results) for build in builders]
    ran = {case.name for case in results.cases}
    return TaskView(
        id=slug("task", layout.name),
        layout=layout,
        leads=[*lead_findings(results, first), *printed_findings(results, first)],
        wins=win_findings(results, first),
        verdicts=tally(every_comparison(results)),
        metrics=[_metric_view(results, metric) for metric in layout.metrics],
        drawings=[draw(each) for each in illustrations if each.task == layout.name],
        summaries=[table for table in summaries if table is not None],
        cases=[case_name(case) for case in results.cases],
        not_run=[case_name(case) for case in layout.cases if case.name not in ran],
    )


def _metric_view(results: TaskResults, metric: str) -> MetricView:
    crossed = results.layout.crossed
    return MetricView(
        title=results.metrics[metric].title,
        table=cross_table(results, metric, crossed) if crossed else score_table(results, metric),
        figure=None if crossed else error_bars(results, metric),
        published=verdict_table(results, metric),
        verdicts=tally(comparisons(results, metric)),
        ranks=_rank_figure(results, metric),
        contrasts=contrast_table(results, metric),
    )


def _rank_figure(results: TaskResults, metric: str) -> Drawing | None:
    ranks, title = ranks_over_cases(results, metric), results.metrics[metric].title
    name = slug(results.layout.name, metric)
    return rank_figure(ranks, f"{title}, ranks over cases", name) if ranks else None


def overall_ranks(tasks: Sequence[TaskResults]) -> list[Drawing]:
    """Return a diagram of the ranks over tasks, for each kind of task that has enough of them."""
    kinds = dict.fromkeys(task.layout.kind for task in tasks)
    found = {k: ranks_over_tasks(t for t in tasks if t.layout.kind == k) for k in kinds}
    return [
        rank_figure(ranks, f"Tasks that {kind}, ranks over tasks", slug("overall", kind))
        for kind, ranks in found.items()
        if ranks
    ]


def missing_data(jobs: Iterable[Trouble]) -> list[MissingData]:
    """Group the jobs that lack data by their message."""
    by_message: dict[str, list[Trouble]] = {}
    for job in jobs:
        by_message.setdefault(job.message, []).append(job)
    return [
        MissingData(
            message, tuple(dict.fromkeys(f"{job.task}: {job.case}" for job in group)), len(group)
        )
        for message, group in by_message.items()
    ]
