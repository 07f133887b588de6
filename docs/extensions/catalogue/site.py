"""All pages: one for each name that is registered, and an index of each kind."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from catalogue.indexes import metric_groups, model_groups, task_groups
from catalogue.metrics import metric_page
from catalogue.models import model_page
from catalogue.places import places
from catalogue.reference import read_today
from catalogue.rendering import render
from catalogue.tasks import task_page
from mocapbench.benchmark.archives import archive_at
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS

__all__ = ["pages"]

Texts = Mapping[str, str]
"""The texts of pages, by name."""


def pages(reference: Path) -> Mapping[str, Texts]:
    """Return all pages, by kind and name.

    Parameters
    ----------
    reference : Path
        The folder of reference values, which holds a folder a profile.
    """
    today = read_today(reference)
    found, archive = places(today), archive_at()
    return {
        "tasks": {
            "index": render("index", title="Tasks", groups=task_groups()),
            **{n: render("task", **task_page(n, today, archive)) for n in TASKS.names()},
        },
        "models": {
            "index": render("index", title="Models", groups=model_groups()),
            **{n: render("model", **model_page(n, found.get(n, ()))) for n in MODELS.names()},
        },
        "metrics": {
            "index": render("index", title="Metrics", groups=metric_groups()),
            **{n: render("metric", **metric_page(n)) for n in METRICS.names()},
        },
    }
