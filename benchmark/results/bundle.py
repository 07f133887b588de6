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
    RowNotes,
    TaskLayout,
    TaskPage,
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
    illustrations : tuple of Illustration, HeatMaps or Space
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
        check=_check(check) if check else None,
    )


def _budget(task: Task, profile: str) -> str:
    selection = task.profiles.get(profile)
    return ", ".join(f"{k}={v}" for k, v in selection.budget.items()) if selection else ""


def _layout(task: Task, records: Sequence[Record], budget: str) -> TaskLayout:
    page = _page(task)
    return TaskLayout(
        name=task.name,
        page=page,
        cases=tuple(
            CaseLayout(
                case.name, case.settings, case.synthetic, task.pools(case), page.notes(case.name)
            )
            for case in task.cases
        ),
        labels=_unique(record.label for record in records if record.task == task.name),
        independent_folds=task.independent_folds,
        budget=budget,
    )


def _page(task: Task) -> TaskPage:
    return TaskPage(
        title=task.title,
        reference=task.reference,
        description=task.description,
        kind=task.kind,
        metrics=task.metrics,
        rows={
            case.name: RowNotes(
                published=case.published, remark=case.remark, not_comparable=case.not_comparable
            )
            for case in task.cases
        },
        published_models=task.published_models,
        published_metrics=task.published_metrics,
        not_comparable=task.not_comparable,
        exempt=task.exempt,
        remarks=task.remarks,
        crossed=task.crossed,
        illustrated=task.illustrated,
    )


def _check(stored: Mapping[str, Any]) -> RegressionCheck:
    """Return a check as the store keeps it, where reference values are called the baseline."""
    findings = [_with_reference(finding) for finding in stored["findings"]]
    return RegressionCheck(**{**_with_reference(stored), "findings": findings})


def _with_reference(stored: Mapping[str, Any]) -> dict[str, Any]:
    return {"reference" if name == "baseline" else name: stored[name] for name in stored}


def _metric_info(name: str) -> MetricInfo:
    metric = METRICS.get(name)
    return MetricInfo(name, metric.title, metric.direction, metric.target)


def _unique(names: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(names))
