"""``mocapbench compare``: two runs, or two models of one run, with honest statistics."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from mocapbench.benchmark.cli.options import Names, split
from mocapbench.benchmark.comparison.compare import Side, between_models, between_runs, tidy
from mocapbench.benchmark.comparison.compare import compare as compare_sides
from mocapbench.benchmark.comparison.output import markdown as to_markdown
from mocapbench.benchmark.comparison.output import notes, terminal
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.files import atomic_write
from mocapbench.benchmark.registry import METRICS, TASKS
from mocapbench.benchmark.runs.store import Store
from mocapbench.metrics.statistics import ROPE

__all__ = ["compare"]


def compare(
    runs: Annotated[list[Path], typer.Argument(help="Two run directories, or one with --models.")],
    models: Names = None,
    tasks: Names = None,
    metrics: Names = None,
    rope: Annotated[
        float, typer.Option(min=0.0, help="Equivalent in practice: this share of the mean value.")
    ] = ROPE,
    markdown: Annotated[Path | None, typer.Option(help="A Markdown file to write.")] = None,
    csv: Annotated[Path | None, typer.Option(help="A CSV file to write, unrounded.")] = None,
) -> None:
    """Set two runs, or two models of one run, against each other, fold by fold."""
    console = Console()
    for path in (markdown, csv):
        if path is not None and not path.parent.is_dir():
            raise UsageError(f"{path}: expected a file in a folder that exists")
    for name in split(tasks):
        TASKS.get(name)
    for name in split(metrics):
        METRICS.get(name)
    first, second, sides = _sides(runs, split(models), console)
    rows = compare_sides(first, second, tasks=split(tasks), metrics=split(metrics), rope=rope)
    for table in terminal(rows, sides):
        console.print(table)
    for note in notes(rows, sides):
        console.print(note, markup=False, highlight=False)
    _write(markdown, to_markdown(rows, sides))
    _write(csv, tidy(rows).to_csv(index=False, lineterminator="\n"))


def _sides(
    runs: Sequence[Path], models: Sequence[str], console: Console
) -> tuple[Side, Side, tuple[str, str]]:
    """Return the two sides, and what to call them."""
    match runs:
        case [run]:
            first, second = between_models(_records(run, console), models)
            return first, second, (models[0], models[1])
        case [one, other]:
            first, second = between_runs(_records(one, console), _records(other, console), models)
            return first, second, _names(one, other)
        case _:
            raise UsageError(f"compare: expected one or two run directories, got {len(runs)}")


def _names(one: Path, other: Path) -> tuple[str, str]:
    """Return the folders' names, which tables have room for, or their paths where these agree."""
    names = one.resolve().name, other.resolve().name
    return names if names[0] != names[1] else (str(one), str(other))


def _records(run: Path, console: Console) -> Side:
    store = Store.open(run)
    records = store.planned()
    for message in store.damaged:
        console.print(f"damaged, so left out: {message}", markup=False)
    return records


def _write(path: Path | None, text: str) -> None:
    if path is not None:
        with atomic_write(path) as file:
            file.write(text.encode())
