"""``mocapbench list``: the registered tasks, models, metrics, libraries and formats."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum
from typing import Annotated

import typer
from rich.table import Table

from mocapbench import baselines
from mocapbench import benchmark as bench
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import Plugins, load_plugins

__all__ = ["app"]

app = typer.Typer(add_completion=False)

_ABILITIES = {
    "Imputer": "imputes any mask",
    "FrameImputer": "imputes whole frames",
    "Inductive": "new recordings too",
    "Interpolator": "interpolates each channel",
    "Synthesiser": "synthesises",
    "Clusterer": "clusters",
    "Aligner": "aligns",
    "Blender": "blends",
    "Informed": "is given the generating process",
    "Misinformed": "is given an unrelated process",
}


class Kind(StrEnum):
    """What can be listed."""

    TASKS = "tasks"
    MODELS = "models"
    METRICS = "metrics"
    LIBRARIES = "libraries"
    FORMATS = "formats"


@app.command("list")
def list_registered(
    kind: Annotated[Kind, typer.Argument(help="What to list.")], plugin: Plugins = None
) -> None:
    """List tasks, models, metrics, libraries of recordings or formats of files."""
    load_plugins(plugin)
    tables: dict[Kind, Callable[[], Table]] = {
        Kind.TASKS: _task_table,
        Kind.MODELS: _model_table,
        Kind.METRICS: _metric_table,
        Kind.LIBRARIES: _library_table,
        Kind.FORMATS: _format_table,
    }
    LiteralConsole().print(tables[kind]())


def _task_table() -> Table:
    table = Table("task", "cases", "profiles", "entrants", "source")
    for name in bench.TASKS.names():
        task = bench.TASKS.get(name)
        cases = ", ".join(case.name for case in task.cases)
        labels = ", ".join(entrant.label for entrant in task.entrants)
        table.add_row(name, cases, ", ".join(task.profiles), labels, task.page.reference)
    return table


def _model_table() -> Table:
    table = Table("model", "abilities", "parameters")
    classes = {text: getattr(baselines, ability) for ability, text in _ABILITIES.items()}
    for name in bench.MODELS.names():
        model = bench.MODELS.get(name)
        abilities = [text for text, ability in classes.items() if issubclass(model, ability)]
        parameters = ", ".join(f"{key}={value}" for key, value in model().get_params().items())
        table.add_row(name, ", ".join(abilities), parameters)
    return table


def _metric_table() -> Table:
    table = Table("metric", "title", "better", "of")
    for name in bench.METRICS.names():
        metric = bench.METRICS.get(name)
        better = metric.direction.value if metric.target is None else f"near {metric.target:g}"
        table.add_row(name, metric.title, better, metric.outcome.__name__.lower())
    return table


def _library_table() -> Table:
    table = Table("library", "what it is")
    for name in bench.LIBRARIES.names():
        first, _, _ = (bench.LIBRARIES.get(name).__doc__ or "").partition("\n")
        table.add_row(name, first)
    return table


def _format_table() -> Table:
    table = Table("format", "files", "needs", "what it is")
    for name in bench.FORMATS.names():
        kind = bench.FORMATS.get(name)
        first, _, _ = (kind.__doc__ or "").partition("\n")
        needs = f"mocapbench[{kind.needs.name}]" if kind.needs else ""
        table.add_row(name, " ".join(kind.suffixes), needs, first)
    return table
