"""What the page says of each model and metric: once, however many names point to it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from mocapbench.reports.bundle.bundle import Bundle
from mocapbench.reports.bundle.layout import TaskLayout
from mocapbench.reports.bundle.metric_info import MetricInfo
from mocapbench.reports.bundle.model_info import ModelInfo
from mocapbench.reports.text import slug

__all__ = ["Facts", "ModelFact", "facts"]

DEFAULTS = "defaults"


@dataclass(frozen=True)
class ModelFact:
    """What there is to know of a model.

    Parameters
    ----------
    id : str
        Unique on the page.
    info : ModelInfo
    entrants : mapping of str to str
        The parameters of each label that sets some.
    """

    id: str
    info: ModelInfo
    entrants: Mapping[str, str]


@dataclass(frozen=True)
class Facts:
    """What there is to know of the models and metrics of a page.

    Parameters
    ----------
    models : tuple of ModelFact
    metrics : mapping of str to MetricInfo
        By the ids of the facts.
    model_ids, metric_ids : mapping of str to str
        The id of the fact of a label, and of a metric by its name; none where there is none.
    """

    models: tuple[ModelFact, ...]
    metrics: Mapping[str, MetricInfo]
    model_ids: Mapping[str, str]
    metric_ids: Mapping[str, str]


def facts(bundle: Bundle) -> Facts:
    """Return the facts of the models and metrics of ``bundle`` that have some."""
    entrants = list(_entrants(bundle.layouts))
    known = {info.name: info for _, _, info in entrants if info.sentence}
    metrics = {slug("metric", m.name): m for m in bundle.metrics.values() if m.sentence}
    return Facts(
        models=tuple(
            ModelFact(_id(name), info, _parameters([e for e in entrants if e[2].name == name]))
            for name, info in known.items()
        ),
        metrics=metrics,
        model_ids={label: _id(info.name) for label, _, info in entrants if info.name in known},
        metric_ids={metric.name: key for key, metric in metrics.items()},
    )


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
