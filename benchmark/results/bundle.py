"""From records to the bundle that a report is made of."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.results.frames import job_table, score_table
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.tasks.base import Task
from mocapbench.reports import (
    Bundle,
    CaseLayout,
    MetricInfo,
    Picture,
    RegressionCheck,
    TaskLayout,
)

__all__ = ["bundle"]


def bundle(
    records: Sequence[Record],
    provenance: Mapping[str, str],
    illustrations: tuple[Picture, ...] = (),
    check: Mapping[str, Any] | None = None,
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
    """
    tasks = [TASKS.get(name) for name in _unique(record.task for record in records)]
    shown = {metric for task in tasks for metric in task.metrics}
    used = shown | {metric for record in records for metric in record.scores}
    return Bundle(
        scores=score_table(records),
        records=job_table(records),
        layouts=tuple(
            _layout(task, records, _budget(task, provenance.get("profile", ""))) for task in tasks
        ),
        metrics={name: _metric_info(name) for name in sorted(used)},
        provenance=provenance,
        illustrations=illustrations,
        check=RegressionCheck(**check) if check else None,
    )


def _budget(task: Task, profile: str) -> str:
    selection = task.profiles.get(profile)
    return ", ".join(f"{k}={v}" for k, v in selection.budget.items()) if selection else ""


def _layout(task: Task, records: Sequence[Record], budget: str) -> TaskLayout:
    return TaskLayout(
        name=task.name,
        title=task.title,
        reference=task.reference,
        kind=task.kind,
        description=task.description,
        cases=tuple(
            CaseLayout(
                case.name,
                case.settings,
                case.published,
                case.synthetic,
                case.remark,
                case.not_comparable,
                task.pools(case),
            )
            for case in task.cases
        ),
        labels=_unique(record.label for record in records if record.task == task.name),
        metrics=task.metrics,
        published_models=task.published_models,
        published_metrics=task.published_metrics,
        not_comparable=task.not_comparable,
        not_controlled=task.not_controlled,
        remarks=task.remarks,
        independent_folds=task.independent_folds,
        crossed=task.crossed,
        budget=budget,
    )


def _metric_info(name: str) -> MetricInfo:
    metric = METRICS.get(name)
    return MetricInfo(name, metric.title, metric.direction, metric.target)


def _unique(names: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(names))
