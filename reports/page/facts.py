"""What the page says of each model and metric: once, however many names point to it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.bundle.layout import TaskLayout
from mocapbench.reports.bundle.model_info import ModelInfo
from mocapbench.reports.text import slug

__all__ = ["facts"]

DEFAULTS = "defaults"


def facts(bundle: Bundle) -> dict[str, Any]:
    """Return the facts of the models and metrics of ``bundle`` that have some.

    Returns
    -------
    dict
        ``models``, the id, the `ModelInfo` and the parameters of the entrants of each model;
        ``metrics``, each `MetricInfo` by its id; and the ids of labels and metrics of which
        something is known, ``model_ids`` and ``metric_ids``.
    """
    entrants = list(_entrants(bundle.layouts))
    known = {info.name: info for _, _, info in entrants if info.sentence}
    metrics = {slug("metric", m.name): m for m in bundle.metrics.values() if m.sentence}
    return {
        "models": [
            (_id(name), info, _parameters([e for e in entrants if e[2].name == name]))
            for name, info in known.items()
        ],
        "metrics": metrics,
        "model_ids": {label: _id(info.name) for label, _, info in entrants if info.name in known},
        "metric_ids": {metric.name: key for key, metric in metrics.items()},
    }


def _id(model: str) -> str:
    return slug("model", model)


def _entrants(layouts: Sequence[TaskLayout]) -> Iterator[tuple[str, str, ModelInfo]]:
    """Give every label with the title of its task and its model."""
    for layout in layouts:
        for label in layout.labels:
            yield label, layout.page.title, layout.model(label)


def _parameters(entrants: Sequence[tuple[str, str, ModelInfo]]) -> dict[str, str]:
    """Return what each label sets, with the tasks where it is not the same in all of them."""
    by_label: dict[str, dict[str, list[str]]] = {}
    for label, task, info in entrants:
        by_label.setdefault(label, {}).setdefault(info.parameters or DEFAULTS, []).append(task)
    return {
        label: _describe_parameters(told)
        for label, told in by_label.items()
        if set(told) != {DEFAULTS}
    }


def _describe_parameters(tasks: Mapping[str, Sequence[str]]) -> str:
    """Return the parameters; those of the most tasks first, the others with their tasks."""
    usual, *others = sorted(tasks, key=lambda parameters: -len(tasks[parameters]))
    return "; ".join([usual, *(f"{other} in {', '.join(tasks[other])}" for other in others)])
