"""``mocapbench export``: everything in a run directory as tables."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mocapbench import benchmark as bench
from mocapbench import reports
from mocapbench.basics.whole_files import atomic_write, write_text, write_together
from mocapbench.basics.words import format_count
from mocapbench.benchmark.cli.console import LiteralConsole
from mocapbench.benchmark.cli.options import DEFAULT_OUT, Out, show_left_out
from mocapbench.benchmark.errors import ExitCode

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["app"]

app = typer.Typer(add_completion=False)


@app.command()
def export(
    out: Out = DEFAULT_OUT,
    to: Annotated[Path | None, typer.Option(help="Folder of the files.")] = None,
) -> None:
    """Write the scores and jobs of the last run as tables.

    As CSV, and as Parquet where pyarrow is installed.
    """
    store, console = bench.RunDirectory(out), LiteralConsole()
    folder, with_parquet = to or out, find_spec("pyarrow") is not None
    folder.mkdir(parents=True, exist_ok=True)
    records = store.planned()
    tables = {"scores": bench.score_table(records), "jobs": bench.job_table(records)}
    suffixes = ".csv and .parquet" if with_parquet else ".csv"
    with write_together(folder, "tables") as drafts:
        for name, table in tables.items():
            _write_csv(table, drafts / f"{name}.csv")
            if with_parquet:
                _write_parquet(table, drafts / f"{name}.parquet")
    for name, table in tables.items():
        console.print(
            f"{format_count(len(table), 'row')}: {folder / name}{suffixes}", soft_wrap=True
        )
    if not with_parquet:
        advice = "no Parquet files, which need pyarrow: `pip install 'mocapbench[parquet]'`"
        console.print(advice)
    show_left_out(store.damaged, console)
    if earlier := len(store.record_keys() - {*store.load_plan()["keys"]}):
        jobs = format_count(earlier, "job")
        console.print(f"not exported: {jobs} of earlier runs in {out}", soft_wrap=True)
    if not records:
        raise typer.Exit(ExitCode.NOTHING_RAN)


def _write_csv(table: pd.DataFrame, path: Path) -> None:
    write_text(path, reports.csv_text(table))


def _write_parquet(table: pd.DataFrame, path: Path) -> None:
    with atomic_write(path) as file:
        table.to_parquet(file, index=False)
