"""What the page of a metric shows."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from catalogue.docstrings import described_function
from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.results.bundle import metric_info

__all__ = ["metric_page"]


def metric_page(name: str) -> Mapping[str, Any]:
    """Return the values of the template of the metric called ``name``."""
    metric = METRICS.get(name)
    pages = {task: TASKS.get(task).page for task in TASKS.names()}
    return {
        "metric": metric,
        "better": metric_info(name).better,
        "outcome": metric.outcome.__name__,
        "text": described_function(metric),
        "scored_by": {task: page for task, page in pages.items() if page.metrics[0] == name},
        "shown_by": {task: page for task, page in pages.items() if name in page.metrics[1:]},
    }
