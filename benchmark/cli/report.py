"""``mocapbench report``: write the HTML report of a run, or of changes between two."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench import reports
from mocapbench.basics.whole_files import write_text
from mocapbench.benchmark import comparison
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import (
    DEFAULT_OUT,
    DataDir,
    Out,
    Plugins,
    load_plugins,
    load_records,
    load_tasks,
    open_archive,
    require_writable,
    show_left_out,
)
from mocapbench.benchmark.errors import UsageError

if TYPE_CHECKING:
    from mocapbench.benchmark import Record, RunDirectory
    from mocapbench.datasets import Archive

__all__ = ["app", "write_report"]

app: typer.Typer = typer.Typer(add_completion=False)


@app.command()
def report(
    runs: Annotated[
        list[Path] | None, typer.Argument(help="Two run directories, to show what changed.")
    ] = None,
    out: Out = DEFAULT_OUT,
    to: Annotated[Path | None, typer.Option(help="The HTML file to write.")] = None,
    data_dir: DataDir = None,
    plugin: Plugins = None,
) -> None:
    """Write the HTML report of a run, or of changes between two."""
    load_plugins(plugin)
    require_writable(to)
    match runs or []:
        case []:
            _report_one(out, to, data_dir)
        case [first, second]:
            _report_two(first, second, to)
        case others:
            raise UsageError(
                f"report: expected two run directories, got {len(others)}; --out names a single one"
            )


def _report_one(out: Path, to: Path | None, data_dir: str | None) -> None:
    store, console = bench.RunDirectory(out), LiteralConsole()
    plan, task_files, records = store.load_plan(), load_tasks(store), load_records(store)
    archive, path = open_archive(data_dir, task_files), to or out / "report.html"
    write_report(records, plan["provenance"], store, archive, path, console)


def _report_two(first: Path, second: Path, to: Path | None) -> None:
    stores, console = [bench.RunDirectory(path) for path in (first, second)], LiteralConsole()
    for store in stores:
        load_tasks(store)
    one, other = (store.planned() for store in stores)
    changes = comparison.run_changes(one, other, comparison.side_names(first, second))
    path = to or second / f"report-against-{first.resolve().name}.html"
    _write(path, reports.render_changes(changes), console)
    show_left_out([message for store in stores for message in store.damaged], console)


def write_report(
    records: Sequence[Record],
    about: Mapping[str, str],
    store: RunDirectory,
    archive: Archive,
    path: Path,
    console: LiteralConsole,
) -> None:
    """Write the page of ``records`` to ``path``, and name what of the store is damaged."""
    figures = bench.illustrations(records, store, archive)
    parts = bench.error_parts(records, archive)
    page = reports.render(bench.bundle(records, about, figures, store.load_check(), parts))
    _write(path, page, console)
    show_left_out(store.damaged, console)


def _write(path: Path, page: str, console: LiteralConsole) -> None:
    write_text(path, page)
    console.print(f"report: {path.resolve()}", soft_wrap=True, highlight=False)
