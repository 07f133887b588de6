"""From records to the bundle that a report is made of."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.results.frames import job_table, score_table
from mocapbench.benchmark.results.interpolations import interpolates
from mocapbench.benchmark.results.model_infos import model_infos
from mocapbench.benchmark.results.origins import origins
from mocapbench.benchmark.results.shown_metrics import shown_metrics
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.tasks.base import Task
from mocapbench.reports import (
    Bundle,
    CaseLayout,
    ErrorParts,
    MetricInfo,
    Picture,
    TaskLayout,
)

__all__ = ["bundle", "metric_info"]


def bundle(
    records: Sequence[Record],
    provenance: Mapping[str, str],
    illustrations: tuple[Picture, ...] = (),
    check: Mapping[str, Any] | None = None,
    parts: ErrorParts | None = None,
) -> Bundle:
    """Return what the report shows of ``records``, which are in table order.

    Parameters
    ----------
    records : sequence of Record
    provenance : mapping of str to str
        Of the run as a whole.
    illustrations : tuple of Illustration or HeatMaps
    check : mapping or None
        The last regression check, as the store keeps it.
    parts : ErrorParts or None
        Errors along gaps and by joint, where they are to be drawn.

    Raises
    ------
    UnknownNameError
        If a record is of a task or of a case that there is not.
    """
    tasks = [TASKS.get(name) for name in _unique(record.address.task for record in records)]
    shown = {metric for task in tasks for metric in task.page.metrics}
    used = shown | {metric for record in records for metric in record.scores}
    return Bundle(
        scores=score_table(records),
        records=job_table(records),
        layouts=tuple(
            _layout(task, records, _budget(task, provenance.get("profile", ""))) for task in tasks
        ),
        metrics={name: metric_info(name) for name in sorted(used)},
        provenance=provenance,
        illustrations=illustrations,
        check=check or None,
        origins=origins(records),
        parts=parts or ErrorParts(),
    )


def _budget(task: Task, profile: str) -> str:
    chosen = task.profiles.get(profile)
    return ", ".join(f"{k}={v}" for k, v in chosen.budget.items()) if chosen else ""


def _layout(task: Task, records: Sequence[Record], budget: str) -> TaskLayout:
    of_task = [record for record in records if record.address.task == task.name]
    for name in _unique(record.address.case for record in of_task):
        task.case(name)  # says so if another version of the task had it
    return TaskLayout(
        name=task.name,
        page=replace(task.page, metrics=shown_metrics(task, of_task)),
        cases=tuple(
            CaseLayout(
                case.name,
                case.columns,
                synthetic=case.synthetic,
                averages_references=task.averages_references(case),
                subjects=case.subjects,
            )
            for case in task.cases
        ),
        labels=_unique(record.address.label for record in of_task),
        independent_folds=task.independent_folds,
        budget=budget,
        models=model_infos(task, of_task),
        interpolations=_unique(r.address.label for r in of_task if interpolates(r.model)),
    )


def metric_info(name: str) -> MetricInfo:
    """Return what a page says of the metric called ``name``."""
    metric = METRICS.get(name)
    return MetricInfo(
        name,
        metric.title,
        metric.direction,
        metric.target,
        of_distribution=metric.needs_variance,
        sentence=metric.sentence,
        unit=metric.unit,
        range=metric.range,
        source=metric.source,
    )


def _unique(names: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(names))
