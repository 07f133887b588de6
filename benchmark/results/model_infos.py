"""What the report says of the model behind each label."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from mocapbench.baselines.declarations.abilities import describe_dependences
from mocapbench.benchmark.docstrings import source, summary
from mocapbench.benchmark.errors import UnregisteredNameError
from mocapbench.benchmark.registry import MODELS, build_unfitted
from mocapbench.benchmark.runs.record import Record
from mocapbench.benchmark.tasks.base import Task
from mocapbench.reports import ModelInfo

__all__ = ["model_infos"]


def model_infos(task: Task, records: Iterable[Record]) -> dict[str, ModelInfo]:
    """Return the model behind each label of ``records``, with what its entrant sets.

    Of a model that is no longer registered, no more than the name is known.
    """
    models = {record.address.label: record.model for record in records}
    chosen = {entrant.label: entrant.parameters for entrant in task.entrants}
    return {label: _info(model, chosen.get(label, {})) for label, model in models.items()}


def _info(name: str, parameters: Mapping[str, object]) -> ModelInfo:
    text = ", ".join(f"{parameter}={value}" for parameter, value in parameters.items())
    try:
        model = MODELS.get(name)
    except UnregisteredNameError:
        return ModelInfo(name, parameters=text)
    unfitted = build_unfitted(name)
    depends_on = ", ".join(describe_dependences(unfitted.provides, unfitted.needs))
    return ModelInfo(name, summary(model), source(model), unfitted.family, text, depends_on)
