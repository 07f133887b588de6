"""Commands that look at what there is: ``list``, ``info`` and ``export``."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from mocapbench.baselines import (
    Aligner,
    Blender,
    Clusterer,
    FrameImputer,
    Imputer,
    Inductive,
    Informed,
    Misinformed,
    Synthesiser,
)
from mocapbench.benchmark.errors import ExitCode
from mocapbench.benchmark.files import atomic_write
from mocapbench.benchmark.registry import METRICS, MODELS, TASKS
from mocapbench.benchmark.results.frames import job_table, score_table
from mocapbench.benchmark.runs.provenance import provenance
from mocapbench.benchmark.runs.store import Store
from mocapbench.datasets import CMU_ACKNOWLEDGEMENT

__all__ = ["export", "info", "list_registered"]

_ABILITIES = (
    (Imputer, "imputes any mask"),
    (FrameImputer, "imputes whole frames"),
    (Inductive, "new recordings too"),
    (Synthesiser, "synthesises"),
    (Clusterer, "clusters"),
    (Aligner, "aligns"),
    (Blender, "blends"),
    (Informed, "is told the process"),
    (Misinformed, "is told another process"),
)
_CITATION = """\
@software{mocapbench,
  title  = {mocapbench: reproducible benchmarks of models of human motion},
  author = {{The mocapbench developers}},
  year   = {2026},
}"""


class Kind(StrEnum):
    """What can be listed."""

    TASKS = "tasks"
    MODELS = "models"
    METRICS = "metrics"


def list_registered(kind: Annotated[Kind, typer.Argument(help="What to list.")]) -> None:
    """List the registered tasks, models or metrics."""
    tables: dict[Kind, Callable[[], Table]] = {
        Kind.TASKS: _task_table,
        Kind.MODELS: _model_table,
        Kind.METRICS: _metric_table,
    }
    Console().print(tables[kind]())


def _task_table() -> Table:
    table = Table("task", "cases", "profiles", "entrants", "source")
    for name in TASKS.names():
        task = TASKS.get(name)
        cases = ", ".join(case.name for case in task.cases)
        labels = ", ".join(entrant.label for entrant in task.entrants)
        table.add_row(name, cases, ", ".join(task.profiles), labels, task.reference)
    return table


def _model_table() -> Table:
    table = Table("model", "abilities", "parameters")
    for name in MODELS.names():
        model = MODELS.get(name)
        abilities = [text for ability, text in _ABILITIES if issubclass(model, ability)]
        parameters = ", ".join(f"{key}={value}" for key, value in model().get_params().items())
        table.add_row(name, ", ".join(abilities), parameters)
    return table


def _metric_table() -> Table:
    table = Table("metric", "title", "better", "of")
    for name in METRICS.names():
        metric = METRICS.get(name)
        better = metric.direction.value if metric.target is None else f"near {metric.target:g}"
        table.add_row(name, metric.title, better, metric.outcome.__name__.lower())
    return table


def info() -> None:
    """Show versions, the machine, and how to cite."""
    table = Table(show_header=False, box=None)
    for name, value in provenance(["mocapbench", "info"], threads=1).items():
        table.add_row(name, value)
    console = Console()
    console.print(table)
    console.print(f"\n{_CITATION}\n\n{CMU_ACKNOWLEDGEMENT}", markup=False, highlight=False)


def export(
    out: Annotated[Path, typer.Option(help="The run directory.")] = Path("mocapbench-results"),
    to: Annotated[Path | None, typer.Option(help="Folder of the two files.")] = None,
) -> None:
    """Write everything in a run directory, scores and jobs, as CSV and Parquet."""
    store, console = Store.open(out), Console()
    folder = to or out
    folder.mkdir(parents=True, exist_ok=True)
    records = store.records()
    for name, table in (("scores", score_table(records)), ("jobs", job_table(records))):
        with atomic_write(folder / f"{name}.csv") as file:
            table.to_csv(file, index=False)
        with atomic_write(folder / f"{name}.parquet") as file:
            table.to_parquet(file, index=False)
        console.print(f"{len(table)} rows: {folder / name}.csv and .parquet", soft_wrap=True)
    for message in store.damaged:
        console.print(f"damaged, so left out: {message}", markup=False)
    if not records:
        raise typer.Exit(ExitCode.NOTHING_RAN)
