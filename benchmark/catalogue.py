"""What is registered, as plain values: of each model, task, metric, library, format what it is."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mocapbench import baselines
from mocapbench.baselines import Model
from mocapbench.benchmark.docstrings import source, summary
from mocapbench.benchmark.errors import UnregisteredNameError
from mocapbench.benchmark.registry import FORMATS, LIBRARIES, METRICS, MODELS, TASKS
from mocapbench.benchmark.runs.request import entrants

__all__ = [
    "entrant_entry",
    "format_entry",
    "library_entry",
    "metric_entry",
    "model_entry",
    "task_entry",
]

_ABILITIES = {
    "Imputer": "fills any gaps",
    "FrameImputer": "fills gaps of whole frames",
    "Inductive": "new recordings too",
    "Interpolator": "fills each channel by itself",
    "Synthesiser": "synthesises",
    "Clusterer": "clusters",
    "Aligner": "aligns",
    "Blender": "blends",
    "Layered": "gives the covariance of each layer",
    "Coregionalised": "gives coregionalisation matrices of each layer",
    "Trended": "gives a common trend",
    "Embedded": "gives latent positions",
    "Dynamical": "gives latent positions with dynamics",
    "Spatial": "takes markers",
    "Replay": "replays training recordings",
    "Informed": "is given the generating process",
    "Misinformed": "is given an unrelated process",
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
        "requires": [_ABILITIES.get(able.__name__, able.__name__) for able in task.requires],
        "metrics": list(task.page.metrics),
        "cases": [case.name for case in task.cases],
        "profiles": {
            profile: {"cases": list(chosen.cases), "folds": chosen.folds}
            for profile, chosen in task.profiles.items()
        },
        "entrants": [entrant.label for entrant in entrants(task)],
        "recordings": list(dict.fromkeys(recordings)),
    }


def model_entry(name: str) -> Mapping[str, Any]:
    """Return what a model is: its sentence and papers, its abilities and parameters."""
    model = MODELS.get(name)
    return {
        "name": name,
        "summary": summary(model),
        "family": model.family,
        "source": source(model),
        "abilities": _abilities(model),
        "parameters": model().get_params(),
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
        "needs": f"mocapbench[{kind.needs.name}]" if kind.needs else "",
    }


def _abilities(model: type[Model]) -> list[str]:
    """Return what a model can do, without what follows from something else that it can do."""
    classes = {text: getattr(baselines, ability) for ability, text in _ABILITIES.items()}
    able = {text: ability for text, ability in classes.items() if issubclass(model, ability)}
    return [
        text
        for text, ability in able.items()
        if not any(issubclass(other, ability) for other in able.values() if other is not ability)
    ]
