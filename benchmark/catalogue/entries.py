"""What is registered, as plain values: of each model, task, metric, library, format what it is."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mocapbench.baselines.declarations.abilities import describe_abilities, describe_dependences
from mocapbench.baselines.declarations.needs import describe_needs
from mocapbench.benchmark.docstrings import source, summary
from mocapbench.benchmark.errors import UnregisteredNameError
from mocapbench.benchmark.registry import FORMATS, LIBRARIES, METRICS, MODELS, TASKS, build_unfitted
from mocapbench.benchmark.runs.request import entrants

__all__ = [
    "entrant_entry",
    "format_entry",
    "library_entry",
    "metric_entry",
    "model_entry",
    "model_summary",
    "task_entry",
    "task_summary",
]


def task_summary(name: str) -> Mapping[str, Any]:
    """Return what a table says of a task, without its entrants, which are many models to import."""
    task = TASKS.get(name)
    return {
        "name": name,
        "title": task.page.title,
        "cases": [case.name for case in task.cases],
        "reference": task.page.reference,
    }


def task_entry(name: str) -> Mapping[str, Any]:
    """Return what a task is: its texts, cases, folds, entrants and recordings."""
    task = TASKS.get(name)
    recordings = (uri for case in task.cases for uri in case.recordings)
    return {
        "name": name,
        "title": task.page.title,
        "question": task.page.question,
        "reference": task.page.reference,
        "description": task.page.description,
        "requires": describe_abilities(task.requires),
        "metrics": list(task.page.metrics),
        "cases": [case.name for case in task.cases],
        "profiles": {
            profile: {"cases": list(chosen.cases), "folds": chosen.folds}
            for profile, chosen in task.profiles.items()
        },
        "entrants": [entrant.label for entrant in entrants(task)],
        "recordings": list(dict.fromkeys(recordings)),
    }


def model_summary(name: str) -> Mapping[str, Any]:
    """Return what a table says of a model."""
    model = build_unfitted(name)
    return {
        "name": name,
        "summary": summary(type(model)),
        "abilities": describe_abilities(model.provides),
        "needs": describe_needs(model.needs),
    }


def model_entry(name: str) -> Mapping[str, Any]:
    """Return what a model is: its sentence and papers, what it can do, depends on and needs."""
    kind, model = MODELS.get(name), build_unfitted(name)
    return {
        "name": name,
        "summary": summary(kind),
        "family": model.family,
        "source": source(kind),
        "abilities": describe_abilities(model.provides),
        "depends on": describe_dependences(model.provides, model.needs),
        "needs": describe_needs(model.needs),
        "parameters": model.get_params(),
    }


def entrant_entry(label: str) -> Mapping[str, Any]:
    """Return what a model is, or a label of the scoreboard, with the parameters that tasks set.

    Raises
    ------
    UnregisteredNameError
        If it is neither.
    """
    tasks = [TASKS.get(name) for name in TASKS.names()]
    every = [(task.name, entrant) for task in tasks for entrant in task.entrants]
    models = {entrant.label: entrant.model for _, entrant in every}
    models |= {name: name for name in MODELS.names()}
    if label not in models:
        raise UnregisteredNameError(MODELS.kind, label, sorted(models))
    own = {"name": label, "model": models[label]} if label != models[label] else {}
    set_by = {
        task: ", ".join(f"{name}={value!r}" for name, value in entrant.parameters.items())
        for task, entrant in every
        if entrant.label == label and entrant.parameters
    }
    return {**model_entry(models[label]), **own, "set by tasks": set_by}


def metric_entry(name: str) -> Mapping[str, Any]:
    """Return what a metric is: its title and facts, which values are better, of what it is."""
    metric = METRICS.get(name)
    return {
        "name": name,
        "title": metric.title,
        "sentence": metric.sentence,
        "unit": metric.unit,
        "range": metric.range,
        "source": metric.source,
        "better": metric.direction.value if metric.target is None else f"near {metric.target:g}",
        "of": metric.outcome.__name__.lower(),
    }


def library_entry(name: str) -> Mapping[str, Any]:
    """Return what a library is: the first line of its docstring, and which files it reads."""
    library = LIBRARIES.get(name)
    return {"name": name, "summary": summary(library), "layout": list(library.layout)}


def format_entry(name: str) -> Mapping[str, Any]:
    """Return what a format is: the first line of its docstring, its suffixes, and its extra."""
    kind = FORMATS.get(name)
    return {
        "name": name,
        "summary": summary(kind),
        "suffixes": list(kind.suffixes),
        "needs": f"mocapbench[{kind.needs[1]}]" if kind.needs else "",
    }
