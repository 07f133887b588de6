"""``mocapbench compare``: two runs, or two models of one run, with paired tests and intervals."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench import reports
from mocapbench.basics.whole_files import encode_text, write_files
from mocapbench.benchmark import comparison
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import (
    Names,
    Plugins,
    load_plugins,
    load_tasks,
    require_writable,
    show_left_out,
    split,
)
from mocapbench.benchmark.errors import UsageError

if TYPE_CHECKING:
    from mocapbench.benchmark.comparison.sides import Side

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)


@app.command()
def compare(
    runs: Annotated[list[Path], typer.Argument(help="Two run directories, or one with --models.")],
    models: Names = None,
    tasks: Names = None,
    metrics: Names = None,
    rope: Annotated[
        float, typer.Option(min=0.0, help="Equivalent in practice: this share of the mean value.")
    ] = 0.02,
    markdown: Annotated[Path | None, typer.Option(help="A Markdown file to write.")] = None,
    csv: Annotated[Path | None, typer.Option(help="A CSV file to write, unrounded.")] = None,
    plugin: Plugins = None,
) -> None:
    """Compare two runs, or two models of one run, by paired folds."""
    load_plugins(plugin)
    console = LiteralConsole()
    require_writable(markdown, csv)
    for path in runs:
        load_tasks(bench.RunDirectory(path))
    for name in split(tasks):
        bench.TASKS.get(name)
    chosen = split(metrics)
    for name in chosen:
        bench.METRICS.get(name)
    first, second, sides = _sides(runs, split(models), console)
    rows = comparison.compare(first, second, tasks=split(tasks), metrics=chosen, rope=rope)
    for table in comparison.terminal(rows, sides):
        console.print(table)
    for metric in dict.fromkeys(chosen):
        if metric not in {row.metric for row in rows}:
            console.print(f"The two have no value of {metric} in common.", highlight=False)
    for note in comparison.notes(rows, sides):
        console.print(note, highlight=False)
    contents = {}
    if markdown is not None:
        contents[markdown] = encode_text(comparison.markdown(rows, sides))
    if csv is not None:
        contents[csv] = encode_text(reports.csv_text(comparison.tidy(rows, sides)))
    write_files(contents)


def _sides(
    runs: Sequence[Path], models: Sequence[str], console: LiteralConsole
) -> tuple[Side, Side, tuple[str, str]]:
    """Return the two sides, and what to call them."""
    match runs:
        case [run]:
            first, second = comparison.between_models(_records(run, console), models)
            return first, second, (models[0], models[1])
        case [one, other]:
            first, second = comparison.between_runs(
                _records(one, console), _records(other, console), models
            )
            return first, second, comparison.side_names(one, other)
        case _:
            raise UsageError(f"compare: expected one or two run directories, got {len(runs)}")


def _records(run: Path, console: LiteralConsole) -> Side:
    store = bench.RunDirectory(run)
    records = comparison.planned_side(store)
    show_left_out(store.damaged, console)
    return records
