"""What the index of each kind shows: groups, and in them a sentence for each name."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

from catalogue.rendering import plain
from mocapbench.benchmark.docstrings import summary
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS
from mocapbench.metrics import Clustering, Imputation, Metric, Recovery, Synthesis
from mocapbench.metrics.base import has_poses
from mocapbench.reports.bundle.model_info import ModelInfo, in_families
from mocapbench.reports.bundle.task_page import QUESTIONS

__all__ = ["Entry", "Group", "metric_groups", "model_groups", "task_groups"]


class Entry(NamedTuple):
    """One page: its name, its title and its sentence as reStructuredText."""

    name: str
    title: str
    sentence: str


class Group(NamedTuple):
    """Pages under one heading."""

    title: str
    about: str
    entries: Sequence[Entry]


def task_groups() -> list[Group]:
    """Return the tasks by the question that they put, in the order of the report."""
    tasks = {name: TASKS.get(name).page for name in TASKS.names()}
    return _not_empty(
        Group(
            title,
            ask,
            [
                Entry(name, page.title, plain(_first_sentence(page.description)))
                for name, page in tasks.items()
                if page.question == question
            ],
        )
        for question, (title, ask) in QUESTIONS.items()
    )


def model_groups() -> list[Group]:
    """Return the models by family, in the order of the report."""
    models = {name: MODELS.get(name) for name in MODELS.names()}
    infos = {name: ModelInfo(name, summary(m), family=m.family) for name, m in models.items()}
    return [
        Group(family, "", [Entry(name, name, plain(infos[name].sentence)) for name in names])
        for family, names in in_families(infos).items()
    ]


def metric_groups() -> list[Group]:
    """Return the metrics by what they measure."""
    metrics = [METRICS.get(name) for name in METRICS.names()]
    kinds = dict.fromkeys((*_KINDS, *map(_kind, metrics)))
    return _not_empty(
        Group(
            kind,
            "",
            [Entry(m.name, m.title, plain(m.sentence)) for m in metrics if _kind(m) == kind],
        )
        for kind in kinds
    )


_KINDS = (
    "Errors of filled values",
    "Filled motion in space",
    "Predictive distributions",
    "Sampled motion",
    "Clusters",
    "Recovered covariances",
)
_BY_OUTCOME = {Imputation: 0, Synthesis: 3, Clustering: 4, Recovery: 5}


def _kind(metric: Metric[Any]) -> str:
    """Return what a metric measures; imputations are scored in three ways."""
    if metric.outcome is not Imputation:
        return _KINDS[_BY_OUTCOME[metric.outcome]]
    if metric.needs_variance:
        return _KINDS[2]
    return _KINDS[metric.defined is has_poses]


def _first_sentence(text: str) -> str:
    first, dot, _ = text.partition(". ")
    return f"{first}." if dot else text


def _not_empty(groups: Iterable[Group]) -> list[Group]:
    return [group for group in groups if group.entries]
