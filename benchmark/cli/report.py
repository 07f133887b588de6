"""``mocapbench report``: write the HTML report of a run directory."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench import reports
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import (
    DEFAULT_OUT,
    DataDir,
    Out,
    Plugins,
    load_plugins,
    load_tasks,
    open_archive,
    require_writable,
    show_left_out,
)
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.files import atomic_write

if TYPE_CHECKING:
    from mocapbench.benchmark import Record, Store
    from mocapbench.datasets import Archive

__all__ = ["app", "write_report"]

app = typer.Typer(add_completion=False)


@app.command()
def report(
    out: Out = DEFAULT_OUT,
    to: Annotated[Path | None, typer.Option(help="The HTML file to write.")] = None,
    data_dir: DataDir = None,
    plugin: Plugins = None,
) -> None:
    """Write the HTML report of a run directory."""
    load_plugins(plugin)
    require_writable(to)
    store, console = bench.Store.open(out), LiteralConsole()
    plan, records, task_files = store.load_plan(), store.planned(), load_tasks(store)
    if not records:
        raise UsageError(f"{out} holds no record of its last run; run `mocapbench run`")
    archive, path = open_archive(data_dir, task_files), to or out / "report.html"
    write_report(records, plan["provenance"], store, archive, path, console)


def write_report(
    records: Sequence[Record],
    about: Mapping[str, str],
    store: Store,
    archive: Archive,
    path: Path,
    console: LiteralConsole,
) -> None:
    """Write the page of ``records`` to ``path``, and name what of the store is damaged."""
    figures = bench.illustrations(records, store, archive)
    parts = bench.error_parts(records, archive)
    page = reports.render(bench.bundle(records, about, figures, store.load_check(), parts))
    with atomic_write(path) as file:
        file.write(page.encode())
    console.print(f"report: {path.resolve()}", soft_wrap=True, highlight=False)
    show_left_out(store.damaged, console)
