"""``mocapbench power``: which difference people can show, and how many a claim needs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench import reports
from mocapbench.basics.whole_files import write_text
from mocapbench.benchmark import comparison
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import (
    DEFAULT_OUT,
    Names,
    Plugins,
    load_plugins,
    load_records,
    load_tasks,
    require_writable,
    show_left_out,
    split,
)

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)

DEFAULT_PEOPLE = ("10", "30", "100")


@app.command()
def power(
    run: Annotated[Path, typer.Argument(help="The run directory.")] = DEFAULT_OUT,
    tasks: Names = None,
    metric: Annotated[str | None, typer.Option(help="By default the first of each task.")] = None,
    models: Annotated[
        list[str] | None,
        typer.Option(help="Two, separated by a comma; by default the best and the next."),
    ] = None,
    people: Annotated[
        list[str] | None,
        typer.Option(help="Numbers of people, by default 10,30,100; or of folds of made data."),
    ] = None,
    difference: Annotated[
        float | None, typer.Option(help="The difference to show; by default the measured one.")
    ] = None,
    alpha: Annotated[float, typer.Option(help="The level of the test.")] = 0.05,
    power: Annotated[float, typer.Option(help="The probability to find the difference.")] = 0.8,
    csv: Annotated[Path | None, typer.Option(help="A CSV file to write, unrounded.")] = None,
    plugin: Plugins = None,
) -> None:
    """Say which difference how many people can show.

    The spread between people is that of the run, of the difference of two models.
    """
    require_writable(csv)
    numbers = comparison.read_numbers(DEFAULT_PEOPLE if people is None else split(people))
    comparison.require_plan(difference, alpha, power)
    load_plugins(plugin)
    store, console = bench.RunDirectory(run), LiteralConsole()
    load_tasks(store)
    spreads = comparison.list_spreads(
        bench.bundle(load_records(store), store.load_plan()["provenance"]),
        tasks=split(tasks),
        metric=metric,
        models=None if models is None else split(models),
    )
    planned = comparison.plan_people(spreads, numbers, difference, alpha, power)
    for table in comparison.power_tables(planned, difference):
        console.print(table)
    for note in comparison.power_notes(alpha, power):
        console.print(note, highlight=False)
    if csv is not None:
        write_text(csv, reports.csv_text(planned))
    show_left_out(store.damaged, console)
