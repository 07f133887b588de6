"""Which metrics a report and a comparison show of a task."""

from __future__ import annotations

from collections.abc import Iterable

from mocapbench.benchmark.registry import METRICS
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.tasks.base import Task

__all__ = ["shown_metrics"]


def shown_metrics(task: Task, records: Iterable[Record]) -> tuple[str, ...]:
    """Return the metrics of a task's page, and of metrics of others those that were scored there.

    The page of a task cannot know of metrics that other packages and files define.

    Parameters
    ----------
    task : Task
    records : iterable of Record
        Those of other tasks do not count.
    """
    scored = {name for r in records if r.address.task == task.name for name in r.scores}
    others = scored.intersection(METRICS.names_of_others()).difference(task.page.metrics)
    return (*task.page.metrics, *sorted(others))
