"""``mocapbench list``: the registered tasks, models, metrics, libraries and formats."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.table import Column, Table

from mocapbench import benchmark as bench
from mocapbench.basics.words import format_count
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import Plugins, load_plugins

if TYPE_CHECKING:
    from mocapbench.benchmark.registry import Registry

__all__ = ["app"]

app: typer.Typer = typer.Typer(add_completion=False)

Entry = Mapping[str, Any]


class ListedKind(StrEnum):
    """What can be listed."""

    TASKS = "tasks"
    MODELS = "models"
    METRICS = "metrics"
    LIBRARIES = "libraries"
    FORMATS = "formats"


@app.command("list")
def list_registered(
    kind: Annotated[ListedKind, typer.Argument(help="What to list.")],
    names: Annotated[
        list[str] | None, typer.Argument(help="Show all there is to say of these.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print all there is to say as JSON.")
    ] = False,
    plugin: Plugins = None,
) -> None:
    """List tasks, models, metrics, libraries or formats of files.

    With names, such as those of tasks, all there is to say of them: cases, entrants, parameters.
    """
    load_plugins(plugin)
    registry, describe, describe_fully, columns = _listing(kind)
    describe_entry = getattr(bench, describe_fully if names or as_json else describe)
    entries = [*map(describe_entry, names or registry.names())]
    if as_json:
        typer.echo(json.dumps(entries, indent=1, default=str))
        return
    console = LiteralConsole()
    if names:
        for entry in entries:
            console.print(_details(entry))
        return
    console.print(_table(registry.kind, columns, entries))
    console.print(f"`mocapbench list {kind} NAME` shows all there is to say of one; --json, of all")


def _listing(kind: ListedKind) -> tuple[Registry[Any], str, str, Mapping[str, str]]:
    """Return how one kind is listed.

    Returns
    -------
    registry : Registry
    describe, describe_fully : str
        The functions of `mocapbench.benchmark` that say what there is to say of one beside others,
        and all of it, which may take longer to import.
    columns : mapping of str to str
        What the table shows besides the name, and under which heads.
    """
    match kind:
        case ListedKind.TASKS:
            columns = {"title": "title", "cases": "cases", "reference": "from"}
            return bench.TASKS, "list_task", "task_entry", columns
        case ListedKind.MODELS:
            columns = {"summary": "what it is", "abilities": "abilities", "needs": "needs"}
            return bench.MODELS, "list_model", "entrant_entry", columns
        case ListedKind.METRICS:
            columns = {"title": "title", "better": "better", "of": "of"}
            return bench.METRICS, "metric_entry", "metric_entry", columns
        case ListedKind.LIBRARIES:
            columns = {"summary": "what it is", "layout": "reads"}
            return bench.LIBRARIES, "library_entry", "library_entry", columns
        case ListedKind.FORMATS:
            columns = {"summary": "what it is", "suffixes": "files", "needs": "needs"}
            return bench.FORMATS, "format_entry", "format_entry", columns


def _table(kind: str, columns: Mapping[str, str], entries: Sequence[Entry]) -> Table:
    """Return one row an entry; of the cases of a task, which may be many, their number."""
    table = Table(Column(kind, no_wrap=True), *columns.values())
    for entry in entries:
        cells = {name: _text(entry[name]) for name in columns}
        if "cases" in cells:
            cells["cases"] = str(len(entry["cases"]))
        table.add_row(entry["name"], *cells.values())
    return table


def _details(entry: Entry) -> Table:
    table = Table(Column(no_wrap=True), Column(overflow="fold"), show_header=False, box=None)
    for name, value in entry.items():
        table.add_row(name, _text(value))
    table.add_row()
    return table


def _text(value: object) -> str:
    match value:
        case {"cases": cases, "folds": folds}:
            return f"{format_count(len(cases), 'case')} × {format_count(folds, 'fold')}"
        case Mapping():
            return ", ".join(f"{name}: {_text(item)}" for name, item in value.items())
        case list():
            return ", ".join(map(_text, value))
        case _:
            return str(value)
